#include "scene/orientations.h"

#include "scene/face_loop.h"
#include "scene/scene.h"

#include <algorithm>
#include <mutex>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <tuple>

namespace visorder {

namespace {

Sign orientation_of_tetrahedron(const Mesh& mesh, CellId cell)
{
    const auto v = mesh.cell(cell);
    return side_of_plane(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]);
}

// A convex cell lies on one side of each of its faces: the first vertex off a face's plane tells which.
Sign orientation_of_zoo_cell(const Mesh& mesh, CellId cell)
{
    for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
        const FaceLoop loop = face_loop(mesh, cell, face);
        if (loop.count < 3)
            continue;
        const auto triple = spanning_triple(mesh, loop);
        if (!triple)
            continue;
        for (PointId v : mesh.cell(cell)) {
            const Sign side =
                side_of_plane(mesh.points[triple->a], mesh.points[triple->b], mesh.points[triple->c], mesh.points[v]);
            if (side != Sign::zero && std::find(loop.begin(), loop.end(), v) == loop.end())
                return -side;
        }
    }
    return Sign::zero;
}

bool is_flat_triangle(const Mesh& mesh, CellId cell)
{
    const auto v = mesh.cell(cell);
    return collinear(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]);
}

// Whether two loops of the same vertices run round the same way.
bool same_way(const FaceLoop& a, const FaceLoop& b)
{
    const auto next_of = [](const FaceLoop& loop, PointId v) {
        const PointId* at = std::find(loop.begin(), loop.end(), v);
        return at + 1 == loop.end() ? *loop.begin() : *(at + 1);
    };
    return next_of(a, *a.begin()) == next_of(b, *a.begin());
}

struct Folds {
    std::vector<CellFace> folded;
    std::vector<CellId> turned_flat;
};

// A face of a tetrahedron with four distinct vertices needs no search for repeated ones.
FaceLoop loop_of(const Mesh& mesh, CellId cell, int face)
{
    if (mesh.shapes[cell] != CellShape::tetrahedron)
        return face_loop(mesh, cell, face);
    const auto v = mesh.cell(cell);
    const auto corners = face_vertices(CellShape::tetrahedron, face);
    return {{v[corners[0]], v[corners[1]], v[corners[2]], 0}, 3};
}

bool same_vertices(const FaceLoop& a, const FaceLoop& b)
{
    return a.count == b.count &&
           std::all_of(a.begin(), a.end(), [&](PointId v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

// What the cell's faces say about folds (of a solid cell) or about its own turn (of a flat one).
void inspect_faces(const Scene& scene, const Orientations& orientations, CellId cell, Folds& folds)
{
    const int sign = orientations.sign[cell];
    const auto row = scene.adjacency().row(cell);
    for (int face = 0; face < face_count(scene.mesh().shapes[cell]); ++face) {
        const CellId neighbour = row[static_cast<std::size_t>(face)];
        // Of two solids the one with the lower number looks at their face for both.
        if (neighbour == cell || orientations.sign[neighbour] == 0 || (sign != 0 && neighbour < cell))
            continue;
        const FaceLoop here = loop_of(scene.mesh(), cell, face);
        const auto row_there = scene.adjacency().row(neighbour);
        int face_there = 0;
        while (row_there[static_cast<std::size_t>(face_there)] != cell ||
               !same_vertices(here, loop_of(scene.mesh(), neighbour, face_there)))
            ++face_there;
        const FaceLoop there = loop_of(scene.mesh(), neighbour, face_there);
        // Two solids on opposite sides of the face run round it in opposite ways, once both are taken from outside.
        const bool turned_alike = same_way(here, there) == ((sign == 0 ? 1 : sign) == orientations.sign[neighbour]);
        if (sign == 0) {
            if (turned_alike)
                folds.turned_flat.push_back(cell);
            return;
        }
        if (turned_alike)
            folds.folded.insert(folds.folded.end(), {{cell, static_cast<std::uint32_t>(face)},
                                                     {neighbour, static_cast<std::uint32_t>(face_there)}});
    }
}

} // namespace

Sign orientation_of(const Mesh& mesh, CellId cell)
{
    return mesh.shapes[cell] == CellShape::tetrahedron ? orientation_of_tetrahedron(mesh, cell)
                                                       : orientation_of_zoo_cell(mesh, cell);
}

Orientations derive_orientations(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    Orientations result;
    result.sign.resize(scene.cell_count());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, scene.cell_count(), 4096), [&](const auto& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell) {
            Sign sign = Sign::zero;
            if (mesh.shapes[cell] != CellShape::triangle)
                sign = orientation_of(mesh, cell);
            result.sign[cell] = static_cast<std::int8_t>(sign);
        }
    });
    if (scene.is_surface()) {
        for (CellId cell = 0; cell < scene.cell_count(); ++cell)
            result.flat += is_flat_triangle(mesh, cell);
        return result;
    }
    result.flat = static_cast<std::size_t>(std::count(result.sign.begin(), result.sign.end(), 0));
    result.inverted = static_cast<std::size_t>(std::count(result.sign.begin(), result.sign.end(), -1));

    const Adjacency& adjacency = scene.adjacency();
    std::mutex mutex;
    Folds all;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, scene.cell_count(), 4096), [&](const auto& range) {
        Folds folds;
        for (CellId cell = range.begin(); cell < range.end(); ++cell)
            if (adjacency.interior[cell] != 0)
                inspect_faces(scene, result, cell, folds);
        if (folds.folded.empty() && folds.turned_flat.empty())
            return;
        const std::lock_guard lock(mutex);
        all.folded.insert(all.folded.end(), folds.folded.begin(), folds.folded.end());
        all.turned_flat.insert(all.turned_flat.end(), folds.turned_flat.begin(), folds.turned_flat.end());
    });
    std::sort(all.folded.begin(), all.folded.end(),
              [](const CellFace& a, const CellFace& b) { return std::tie(a.cell, a.face) < std::tie(b.cell, b.face); });
    std::sort(all.turned_flat.begin(), all.turned_flat.end());
    result.folded = std::move(all.folded);
    result.turned_flat = std::move(all.turned_flat);
    return result;
}

} // namespace visorder
