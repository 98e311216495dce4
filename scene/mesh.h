#pragma once

#include "scene/cell_shape.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace visorder {

/// The cells of a scene as plain data, in the caller's numbering. Coordinates are taken as exact.
/// Either all cells are solids (tetrahedra, pyramids, wedges, hexahedra) or all are triangles (a surface scene).
struct Mesh {
    std::vector<glm::dvec3> points;
    std::vector<CellShape> shapes;
    std::vector<std::uint32_t> offsets;  ///< cell i's vertices are vertices[offsets[i]] up to vertices[offsets[i + 1]]
    std::vector<std::uint32_t> vertices; ///< indices into points, in VTK's vertex order within each shape
    std::vector<float> scalars;          ///< one a point, or empty

    std::size_t cell_count() const { return shapes.size(); }
    std::span<const std::uint32_t> cell(CellId i) const
    {
        return {vertices.data() + offsets[i], vertices.data() + offsets[i + 1]};
    }

    /// Appends a cell; `cell_vertices` has as many indices as the shape has vertices.
    void add(CellShape shape, std::span<const std::uint32_t> cell_vertices);
};

/// Throws InputError, naming the cell or point, for a mesh that no scene can be made of: no cells, offsets that do not
/// fit, an index out of range, a NaN or infinite coordinate, a wrong vertex count, a scalar count that does not fit,
/// triangles mixed with solids, more than 2^29 cells.
void validate(const Mesh& mesh);

/// Joins points with exactly equal coordinates (0.0 and -0.0 are equal), keeping of each set the one with the lowest
/// index, with its scalar; points keep their relative order. Returns how many points went.
std::size_t weld(Mesh& mesh);

/// Joins points that lie within `tolerance` of each other, a distance of 0 or more: in the order of their indices, each
/// joins the first of the points kept so far that is near enough, or is kept itself. So two points that are joined lie
/// up to twice the tolerance apart. Exactly equal ones are joined in any case. Returns how many points went. Throws
/// InputError for a tolerance that is negative or not finite.
std::size_t weld(Mesh& mesh, double tolerance);

} // namespace visorder
