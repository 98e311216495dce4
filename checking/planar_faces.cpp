#include "checking/planar_faces.h"

#include "geometry/exact_predicates.h"
#include "scene/face_loop.h"
#include "visorder/error.h"
#include "visorder/scene.h"

#include <atomic>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

void require_planar_faces(const Scene& scene)
{
    if (scene.is_surface() || scene.is_tetrahedral())
        return;
    const Mesh& mesh = scene.mesh();
    const auto is_planar = [&](CellId cell, int face) {
        const FaceLoop loop = face_loop(mesh, cell, face);
        const PointId* v = loop.begin();
        return loop.count < 4 ||
               side_of_plane(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]) == Sign::zero;
    };
    constexpr CellId none = std::numeric_limits<CellId>::max();
    std::atomic<CellId> lowest{none};
    const auto look_at = [&](CellId cell) {
        for (int face = 0; face < face_count(mesh.shapes[cell]); ++face)
            if (!is_planar(cell, face)) {
                CellId known = lowest.load();
                const CellId caller = scene.caller_cells()[cell];
                while (caller < known && !lowest.compare_exchange_weak(known, caller)) {}
                return;
            }
    };
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, scene.cell_count(), 4096), [&](const auto& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell)
            look_at(cell);
    });
    if (lowest != none)
        throw CellError(lowest.load(), "a face is not planar; subdivide the mesh into tetrahedra");
}

} // namespace visorder::detail
