#include "projection/boundary_slab.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace visorder {

namespace {

std::optional<BoundarySlab> slab_of(const TriangleSources& from, const std::array<PointId, 3>& face, bool entry)
{
    const ScreenPoints& points = from.cells->points();
    BoundarySlab slab{face, {}, {}, {}, {}, entry};
    std::array<glm::dvec2, 3> exact;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec4& p = points.exact[face[i]];
        slab.at[i] = points.snapped[face[i]];
        exact[i] = {p.x, p.y};
        slab.depth[i] = p.z;
        slab.scalar[i] = p.w * (1 - slab.depth[i] * from.screen->inverse_distance());
    }
    const glm::dvec2 slope = slope_of(exact, slab.depth);
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        slab.missing[i] = glm::dot(slope, glm::dvec2(slab.at[i]) / static_cast<double>(from.lattice.steps) - exact[i]);
        most = std::max(most, std::abs(slab.missing[i]));
    }
    const auto [nearest, farthest] = std::minmax_element(slab.depth.begin(), slab.depth.end());
    if (!(most > 0 && most < 0.5 * (*farthest - *nearest)))
        return std::nullopt;
    return slab;
}

} // namespace

glm::dvec2 slope_of(const std::array<glm::dvec2, 3>& corners, const std::array<double, 3>& value)
{
    const glm::dvec2 b = corners[1] - corners[0];
    const glm::dvec2 c = corners[2] - corners[0];
    const glm::dvec2 sum =
        (value[1] - value[0]) * glm::dvec2(c.y, -c.x) - (value[2] - value[0]) * glm::dvec2(b.y, -b.x);
    return sum / (b.x * c.y - b.y * c.x);
}

std::vector<BoundarySlab> boundary_slabs(const TriangleSources& from, CellId cell, bool entries)
{
    std::vector<BoundarySlab> slabs;
    const std::uint8_t interior = from.scene->adjacency().interior[cell];
    const auto v = from.scene->mesh().cell(cell);
    const auto& snapped = from.cells->points().snapped;
    for (int f = 0; f < 4; ++f) {
        if ((interior >> f & 1) != 0)
            continue;
        // Counterclockwise from outside, unless the cell is turned.
        const auto corners = face_vertices(CellShape::tetrahedron, f);
        const std::array<PointId, 3> face{v[corners[0]], v[corners[1]], v[corners[2]]};
        const glm::ivec2 a = snapped[face[0]];
        const glm::ivec2 b = snapped[face[1]];
        const glm::ivec2 c = snapped[face[2]];
        const std::int64_t area = std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
        const bool entry = (area > 0) != from.cells->turned(cell);
        if (area == 0 || entry != entries || !from.cells->covers_a_centre(a, b, c))
            continue;
        if (const auto slab = slab_of(from, face, entry))
            slabs.push_back(*slab);
    }
    return slabs;
}

} // namespace visorder
