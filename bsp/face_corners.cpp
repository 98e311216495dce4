#include "bsp/face_corners.h"

#include "geometry/exact_predicates.h"
#include "scene/adjacency.h"
#include "scene/face_loop.h"

#include <algorithm>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

// Points that coincide count as one, and the first three span the plane.
FaceCorners::Corners corners_of(const Mesh& mesh, const CellFace& face)
{
    FaceCorners::Corners corners{};
    std::size_t count = 0;
    for (PointId v : boundary_loop(mesh, face)) {
        const auto end = corners.begin() + count;
        if (std::none_of(corners.begin(), end, [&](PointId w) { return mesh.points[w] == mesh.points[v]; }))
            corners[count++] = v;
    }
    while (collinear(mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]))
        std::rotate(corners.begin(), corners.begin() + 1, corners.begin() + count);
    if (count == 3)
        corners[3] = corners[2];
    return corners;
}

} // namespace

FaceCorners::FaceCorners(const Mesh& mesh, std::span<const CellFace> faces, std::span<const std::uint8_t> has_area)
    : corners_(faces.size())
{
    oneapi::tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t i) {
        if (has_area[i] != 0)
            corners_[i] = corners_of(mesh, faces[i]);
    });
    std::vector<PointId> used;
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (has_area[i] != 0)
            used.insert(used.end(), corners_[i].begin(), corners_[i].end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    points_.reserve(used.size());
    for (PointId v : used)
        points_.push_back(mesh.points[v]);
    oneapi::tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t i) {
        if (has_area[i] != 0)
            for (std::uint32_t& corner : corners_[i])
                corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
    });
}

SeenFace FaceCorners::seen(std::uint32_t face, const glm::dvec4& eye) const
{
    const Corners& corners = corners_[face];
    SeenFace seen;
    seen.count = count(corners);
    for (std::size_t i = 0; i < static_cast<std::size_t>(seen.count); ++i)
        seen.points[i] = points_[corners[i]];
    seen.turn = side_of_plane(seen.points[0], seen.points[1], seen.points[2], eye);
    return seen;
}

} // namespace visorder::detail
