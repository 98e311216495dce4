#include "projection/triangle_records.h"

#include "projection/silhouette.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>

namespace visorder {

namespace {

// Whether a point is on the inner side of an edge or on it. Coordinates are below 2^22, see RasterLattice.
std::int64_t side(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& p)
{
    return std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{b.y - a.y} * (p.x - a.x);
}

bool holds(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c, const glm::ivec2& p)
{
    const std::int64_t ab = side(a, b, p);
    const std::int64_t bc = side(b, c, p);
    const std::int64_t ca = side(c, a, p);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

// More are left to the rasteriser.
constexpr int most_centres_tried = 6;

} // namespace

SilhouetteTriangles::SilhouetteTriangles(const Scene& scene, std::span<const std::uint8_t> turned,
                                         const ScreenPoints& points, const Screen& screen,
                                         const RasterLattice& lattice)
    : vertices_(scene.mesh().vertices), turned_(turned), points_(points), first_(-screen.centre()),
      last_(screen.size() - screen.centre() - 1), half_step_(lattice.steps / 2),
      shift_(std::countr_zero(static_cast<unsigned>(lattice.steps)))
{
}

bool SilhouetteTriangles::covers_a_centre(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) const
{
    // Pixel i has its centre at i steps + half_step.
    const glm::ivec2 low = glm::min(glm::min(a, b), c) - half_step_;
    const glm::ivec2 high = glm::max(glm::max(a, b), c) - half_step_;
    const int mask = (1 << shift_) - 1;
    const glm::ivec2 first = glm::max(glm::ivec2((low.x + mask) >> shift_, (low.y + mask) >> shift_), first_);
    const glm::ivec2 last = glm::min(glm::ivec2(high.x >> shift_, high.y >> shift_), last_);
    const int columns = last.x - first.x + 1;
    const int rows = last.y - first.y + 1;
    if (columns <= 0 || rows <= 0)
        return false;
    if (columns * rows > most_centres_tried || columns > most_centres_tried || rows > most_centres_tried)
        return true;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            if (holds(a, b, c, {(x << shift_) + half_step_, (y << shift_) + half_step_}))
                return true;
    return false;
}

std::size_t SilhouetteTriangles::make(std::span<const CellId> cells, std::byte* into,
                                      std::vector<CellOffLattice>& off_lattice) const
{
    auto* const first = reinterpret_cast<TriangleRecord*>(into);
    TriangleRecord* next = first;
    for (const CellId cell : cells) {
        const std::uint32_t* v = vertices_.data() + std::size_t{cell} * 4;
        const std::uint8_t shared =
            points_.sides[v[0]] & points_.sides[v[1]] & points_.sides[v[2]] & points_.sides[v[3]];
        if ((shared & sides::all) != 0)
            continue;
        const std::uint8_t any = points_.sides[v[0]] | points_.sides[v[1]] | points_.sides[v[2]] | points_.sides[v[3]];
        if ((any & sides::off_lattice) != 0) {
            off_lattice.push_back({static_cast<std::uint32_t>(next - first), cell});
            continue;
        }
        const std::array<glm::ivec2, 4> at{points_.snapped[v[0]], points_.snapped[v[1]], points_.snapped[v[2]],
                                           points_.snapped[v[3]]};
        const glm::ivec2 low = glm::min(glm::min(at[0], at[1]), glm::min(at[2], at[3])) - half_step_;
        const glm::ivec2 high = glm::max(glm::max(at[0], at[1]), glm::max(at[2], at[3])) - half_step_;
        const int mask = (1 << shift_) - 1;
        if ((low.x + mask) >> shift_ > high.x >> shift_ || (low.y + mask) >> shift_ > high.y >> shift_)
            continue;
        const Silhouette silhouette = silhouette_of(at);
        if (silhouette.kind == SilhouetteClass::empty)
            continue;
        const auto& order = silhouette.points;
        const bool first_behind = silhouette.first_behind != (turned_[cell] != 0);
        if (silhouette.kind == SilhouetteClass::triangle) {
            if (!covers_a_centre(at[order[1]], at[order[2]], at[order[3]]))
                continue;
            const std::uint32_t kind = first_behind ? record_kinds::inner_behind : record_kinds::inner_before;
            *next++ = {v[order[0]] | kind << record_kinds::shift, v[order[1]], v[order[2]], v[order[3]]};
            continue;
        }
        const std::size_t nearer = first_behind ? 2 : 0;
        const std::array<std::uint8_t, 4> edges{order[nearer], order[nearer + 1], order[2 - nearer], order[3 - nearer]};
        const TriangleRecord record{v[edges[0]], v[edges[1]], v[edges[2]], v[edges[3]]};
        const auto half = [&](std::size_t corner, std::uint32_t kind) {
            if (!covers_a_centre(at[edges[0]], at[edges[1]], at[edges[corner]]))
                return;
            *next = record;
            (*next++)[0] |= kind << record_kinds::shift;
        };
        half(2, record_kinds::quad_third);
        half(3, record_kinds::quad_fourth);
    }
    return static_cast<std::size_t>(next - first);
}

} // namespace visorder
