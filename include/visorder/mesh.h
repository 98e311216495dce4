#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace visorder {

using CellId = std::uint32_t;
using PointId = std::uint32_t;

/// The shapes a cell can have: solids of finite-element meshes, and the triangle of surface scenes. Vertices are
/// numbered as VTK numbers them within each shape.
enum class CellShape : std::uint8_t { triangle, tetrahedron, pyramid, wedge, hexahedron };

inline constexpr int max_cell_vertices = 8;
inline constexpr int max_cell_faces = 6;
inline constexpr int max_face_vertices = 4;

const char* name(CellShape shape);

/// Vertices of a cell of this shape: 3 to 8.
int vertex_count(CellShape shape);

/// Faces of a cell of this shape: 4 to 6, or the three edges of a triangle.
int face_count(CellShape shape);

/// The vertices of a face, as indices into the cell's own vertices (VTK numbering), counterclockwise from outside where
/// the cell's vertices stand in VTK's order. Two for an edge of a triangle, else three or four.
/// `face` is in [0, face_count(shape)).
std::span<const std::uint8_t> face_vertices(CellShape shape, int face);

/// The cells of a scene as plain data, in the caller's numbering. Coordinates are taken as exact.
/// Either all cells are solids (tetrahedra, pyramids, wedges, hexahedra) or all are triangles (a surface scene).
struct Mesh {
    std::vector<glm::dvec3> points;
    std::vector<CellShape> shapes;
    std::vector<std::uint32_t> offsets;  ///< cell i's vertices are vertices[offsets[i]] up to vertices[offsets[i + 1]]
    std::vector<std::uint32_t> vertices; ///< indices into points, in VTK's vertex order within each shape
    std::vector<float> scalars;          ///< one per point, or empty

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

/// The result of `subdivide`: tetrahedra, and for each the cell that it is part of.
struct Subdivision {
    Mesh mesh;
    std::vector<CellId> cell_of; ///< ascending: the parts of one cell stand together, in the order of the cells
};

/// Consistent subdivision of mixed-element cells into tetrahedra by the smallest-vertex rule (Max, Williams and Silva
/// 2000, Approximate volume rendering for curvilinear and unstructured grids by hardware-assisted polyhedron
/// projection, section IV; a simplification of Nielson and Sung 1997): the diagonal of each quadrilateral starts at its
/// smallest vertex index, so that two cells that share a quadrilateral always cut it the same way. A pyramid becomes
/// two tetrahedra, a wedge three, a hexahedron five or six.
///
/// Points and scalars are unchanged; triangles and tetrahedra pass through. The tetrahedra of a cell whose vertices
/// stand in VTK's order stand in VTK's order too. A collapsed cell (with repeated vertex indices) gives as many
/// tetrahedra as any, some of them with repeated vertices.
///
/// Throws InputError for a mesh that is not valid (see `validate`), and where the parts would be too many for a mesh.
Subdivision subdivide(const Mesh& mesh);

} // namespace visorder
