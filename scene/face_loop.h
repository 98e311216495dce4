#pragma once

#include "geometry/exact_predicates.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <array>
#include <optional>

namespace visorder::detail {

/// The distinct vertices of a face in the order of `face_vertices`: a face with repeated vertices (in a mesh whose
/// points were joined) is the polygon that is left of it. Fewer than three: the face collapsed and is none.
struct FaceLoop {
    std::array<PointId, max_face_vertices> vertices;
    int count = 0;

    const PointId* begin() const { return vertices.data(); }
    const PointId* end() const { return vertices.data() + count; }
};

inline FaceLoop face_loop(const Mesh& mesh, CellId cell, int face)
{
    FaceLoop loop;
    const auto cell_vertices = mesh.cell(cell);
    for (std::uint8_t local : face_vertices(mesh.shapes[cell], face)) {
        const PointId v = cell_vertices[local];
        if (std::find(loop.begin(), loop.end(), v) == loop.end())
            loop.vertices[static_cast<std::size_t>(loop.count++)] = v;
    }
    return loop;
}

/// The same of a boundary face of a solid, or of a triangle of a surface, which is face 0 of itself.
inline FaceLoop boundary_loop(const Mesh& mesh, const CellFace& face)
{
    if (mesh.shapes[face.cell] != CellShape::triangle)
        return face_loop(mesh, face.cell, static_cast<int>(face.face));
    FaceLoop loop;
    for (PointId v : mesh.cell(face.cell))
        if (std::find(loop.begin(), loop.end(), v) == loop.end())
            loop.vertices[static_cast<std::size_t>(loop.count++)] = v;
    return loop;
}

/// Three points of a face that span its plane, in the face's order; none if all its points are collinear.
struct FaceTriple {
    PointId a, b, c;

    friend bool operator==(const FaceTriple&, const FaceTriple&) = default;
};
std::optional<FaceTriple> spanning_triple(const Mesh& mesh, const FaceLoop& loop);

/// Exactly: whether three points lie on one line.
bool collinear(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Whether the cell has too few distinct vertices for a solid (or, in a surface scene, for a triangle): it has no
/// faces.
inline bool is_collapsed(const Mesh& mesh, CellId cell)
{
    const auto v = mesh.cell(cell);
    if (mesh.shapes[cell] == CellShape::tetrahedron)
        return v[0] == v[1] || v[0] == v[2] || v[0] == v[3] || v[1] == v[2] || v[1] == v[3] || v[2] == v[3];
    std::array<PointId, max_cell_vertices> distinct;
    std::copy(v.begin(), v.end(), distinct.begin());
    const auto end = distinct.begin() + static_cast<std::ptrdiff_t>(v.size());
    std::sort(distinct.begin(), end);
    const auto count = std::unique(distinct.begin(), end) - distinct.begin();
    return count < (mesh.shapes[cell] == CellShape::triangle ? 3 : 4);
}

} // namespace visorder::detail
