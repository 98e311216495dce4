#include "xmpvo/boundary_surface.h"

#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "scene/face_planes.h"
#include "visorder/scene.h"

#include <algorithm>
#include <tuple>

namespace visorder::detail {

namespace {

struct Side {
    std::uint32_t a, b, face;
};

std::vector<Side> sides_of_faces(const BoundarySurface& surface)
{
    std::vector<Side> sides;
    for (std::uint32_t face = 0; face < surface.faces.size(); ++face) {
        const auto corners = surface.corners(face);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto [a, b] = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
            sides.push_back({a, b, face});
        }
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& s, const Side& t) { return std::tie(s.a, s.b, s.face) < std::tie(t.a, t.b, t.face); });
    return sides;
}

} // namespace

BoundarySurface boundary_surface(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    const FacePlanes& planes = scene.face_planes();
    const std::vector<CellFace>& faces = scene.boundary().faces;
    BoundarySurface surface;
    std::vector<PointId> used;
    for (const CellFace& face : faces)
        for (PointId v : face_loop(mesh, face.cell, static_cast<int>(face.face)))
            used.push_back(v);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (PointId v : used)
        surface.points.push_back(planes.frame.unit(mesh.points[v]));
    for (const CellFace& face : faces) {
        const FaceLoop loop = face_loop(mesh, face.cell, static_cast<int>(face.face));
        BoundarySurface::Corners corners;
        for (int i = 0; i < 4; ++i) {
            const PointId v = loop.vertices[static_cast<std::size_t>(std::min(i, loop.count - 1))];
            corners[static_cast<std::size_t>(i)] =
                static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
        }
        surface.faces.push_back(corners);
        surface.triangles &= loop.count == 3;
    }
    for (const Side& side : sides_of_faces(surface)) {
        const auto at = static_cast<std::uint32_t>(surface.edge_faces.size());
        if (surface.edges.empty() || surface.edges.back().a != side.a || surface.edges.back().b != side.b)
            surface.edges.push_back({side.a, side.b, at, at});
        surface.edge_faces.push_back(side.face);
        ++surface.edges.back().end;
    }
    return surface;
}

std::size_t BoundarySurface::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return size_of(points) + size_of(faces) + size_of(edges) + size_of(edge_faces);
}

} // namespace visorder::detail
