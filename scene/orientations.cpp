#include "scene/orientations.h"

#include "scene/face_loop.h"
#include "visorder/scene.h"

#include <algorithm>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

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
    return result;
}

} // namespace visorder::detail
