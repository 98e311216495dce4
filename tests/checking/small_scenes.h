#pragma once

#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "visorder/mesh.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <random>
#include <string>
#include <vector>

namespace visorder {
class Scene;
}

namespace visorder::tests {

using namespace detail;

/// The same numbers on every machine.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// In [0, count).
    int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }
    /// In [low, high].
    int from_to(int low, int high) { return low + below(high - low + 1); }
    /// In [0, 1).
    double real() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    glm::dvec3 integer_point(int low, int high)
    {
        const int x = from_to(low, high), y = from_to(low, high), z = from_to(low, high);
        return {x, y, z};
    }

private:
    std::mt19937_64 engine_;
};

struct SmallScene {
    std::string name;
    Mesh mesh;
};

/// Scenes of few cells with integer coordinates in [0, 64]: Delaunay meshes with cells carved away, boxes that touch in
/// parts of their faces, with and without boxes missing, and single cells of all shapes that meet anyhow but never
/// overlap.
std::vector<SmallScene> small_scenes();

/// The Delaunay tetrahedralisation of random points with integer coordinates in [0, size], of which no five lie on a
/// sphere; of the cells, about `keep` remain.
Mesh carved_delaunay(int points, int size, double keep, std::uint64_t seed);

/// Unit boxes times `spacing` in a grid, each missing with some probability, each whole, or two wedges, or (if
/// `spacing` is even) six pyramids; faces of different kinds of boxes need not match where they meet.
Mesh box_grid(glm::ivec3 boxes, int spacing, double missing, std::uint64_t seed);

/// The same of whole boxes, so that all faces between them match.
Mesh whole_boxes(glm::ivec3 boxes, int spacing, double missing, std::uint64_t seed);

/// Convex cells of random shapes, with integer coordinates in [0, size], none of which overlap.
Mesh scattered_cells(int attempts, int size, std::uint64_t seed);

/// One scene of the endless sequence of all these kinds, without those of small cells in large boxes: 1, 2, 3, ...
Mesh small_scene(std::uint64_t number);

/// A random convex cell with integer coordinates in [low, high] and planar faces; `add_random_cell` appends its points
/// and the cell. Not flat.
void add_random_cell(Mesh& mesh, Random& random, int low, int high);

/// Appends a hexahedron, its corners as VTK numbers them.
void add_box(Mesh& mesh, const std::array<glm::dvec3, 8>& corners);

/// Appends the box between two corners, of which `low` is the lower one along each axis.
void add_box(Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high);

/// Three bars along the sides of a triangle, each passing over the next at one end and under the one before at the
/// other, as seen along z: solids that do not touch, or triangles.
Mesh interlocked_bars(bool solids);

/// The surface of every three corners.
Mesh triangles(const std::vector<glm::dvec3>& corners);

/// Triangles whose corners have integer coordinates in [0, size], some of no area.
Mesh random_triangles(int count, int size, std::uint64_t seed);

/// Cells with integer coordinates in [0, size] that overlap in space wherever they happen to.
Mesh overlapping_cells(int count, int size, std::uint64_t seed);

/// Tetrahedra below and above a flat one between them, and more flat ones: at a boundary face, alone, and collapsed.
Mesh flat_cells();

/// A carved Delaunay mesh, every few points of which were moved to one plane: many flat, inverted and overlapping
/// cells.
Mesh squashed_delaunay(std::uint64_t seed);

/// The points of a boundary face of a solid, or of a triangle of a surface.
std::vector<glm::dvec3> points_of(const Scene& scene, const CellFace& face);

/// Eyes with integer coordinates, or directions, that are hard on this scene: far and near ones, at a vertex, in the
/// middle, in planes of faces, along the axes.
std::vector<glm::dvec4> small_scene_eyes(const Scene& scene, std::uint64_t seed);

} // namespace visorder::tests
