#include "projection/visible_cells.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>

namespace visorder {

namespace {

// Positive to the left of the way from a to b. Coordinates are below 2^22, see RasterLattice.
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

VisibleCells::VisibleCells(const Scene& scene, std::span<const std::uint8_t> turned, const ScreenPoints& points,
                           const Screen& screen, const RasterLattice& lattice)
    : vertices_(scene.mesh().vertices),
      turned_(turned),
      points_(points),
      first_(-screen.centre()),
      last_(screen.size() - screen.centre() - 1),
      half_step_(lattice.steps / 2),
      shift_(std::countr_zero(static_cast<unsigned>(lattice.steps))),
      mirrored_(screen.mirrors())
{
}

bool VisibleCells::covers_a_centre(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) const
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
    if (columns > most_centres_tried || rows > most_centres_tried || columns * rows > most_centres_tried)
        return true;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            if (holds(a, b, c, {(x << shift_) + half_step_, (y << shift_) + half_step_}))
                return true;
    return false;
}

bool VisibleCells::complete(VisibleCell& cell, const Silhouette& silhouette, const std::uint32_t* v,
                            const std::array<glm::ivec2, 4>& at) const
{
    if (silhouette.kind == SilhouetteClass::empty)
        return false;
    cell.kind = silhouette.kind;
    const bool first_behind = silhouette.first_behind != turned(cell.cell);
    // The nearer edge of a quad comes first.
    const std::size_t rotated = silhouette.kind == SilhouetteClass::quad && first_behind ? 2 : 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint8_t point = silhouette.points[i ^ rotated];
        cell.points[i] = v[point];
        cell.at[i] = at[point];
    }
    if (silhouette.kind == SilhouetteClass::triangle) {
        cell.inner_behind = first_behind;
        cell.first_half = covers_a_centre(cell.at[1], cell.at[2], cell.at[3]);
        return cell.first_half;
    }
    cell.first_half = covers_a_centre(cell.at[0], cell.at[1], cell.at[2]);
    cell.second_half = covers_a_centre(cell.at[0], cell.at[1], cell.at[3]);
    return cell.first_half || cell.second_half;
}

} // namespace visorder
