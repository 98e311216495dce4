#include "projection/surface_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace visorder::detail {

namespace {

constexpr double rounded_by = 0x1p-21; // of a pixel's coordinate in single precision, a part of it
constexpr double slack = 1e-6;         // pixels, for what rounding in doubles may take from a box
constexpr double longest_tip = 16;     // pixels that a corner may be moved by

bool is_before(const SurfacePoint& a, const SurfacePoint& b)
{
    if (a.x != b.x)
        return a.x < b.x;
    return a.y != b.y ? a.y < b.y : a.z < b.z;
}

// The same from both ends, but for the sign.
glm::dvec3 edge_between(const SurfacePoint& a, const SurfacePoint& b)
{
    return is_before(a, b) ? glm::cross(a, b) : -glm::cross(b, a);
}

// What is left of a polygon where `inside` is not negative.
template <class Inside>
std::vector<SurfacePoint> clipped(const std::vector<SurfacePoint>& polygon, const Inside& inside)
{
    std::vector<SurfacePoint> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const SurfacePoint& a = polygon[i];
        const SurfacePoint& b = polygon[(i + 1) % polygon.size()];
        const double at_a = inside(a), at_b = inside(b);
        if (at_a >= 0)
            result.push_back(a);
        if ((at_a >= 0) != (at_b >= 0))
            result.push_back(glm::mix(a, b, at_a / (at_a - at_b)));
    }
    return result;
}

} // namespace

SurfacePoint surface_point(const Screen& screen, const glm::dvec3& point)
{
    const glm::dvec3 place = screen.anywhere(point).place;
    return screen.perspective() ? place * screen.inverse_distance() : place;
}

SurfaceTriangles::SurfaceTriangles(const Screen& screen, const RasterLattice& lattice)
    : low_(-glm::dvec2(screen.centre())),
      high_(screen.size() - screen.centre()),
      step_(1.0 / lattice.steps),
      range_(lattice.half_range - 1)
{
}

bool SurfaceTriangles::make(const std::array<SurfacePoint, 3>& corners, SurfaceTriangle& result) const
{
    std::array<glm::dvec3, 3> edges; // each opposite a corner
    for (std::size_t i = 0; i < 3; ++i)
        edges[i] = edge_between(corners[(i + 1) % 3], corners[(i + 2) % 3]);
    const double turn = glm::dot(corners[0], edges[0]);
    if (!std::isfinite(turn) || turn == 0)
        return false;
    for (std::size_t i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            result.edges[3 * i + static_cast<std::size_t>(k)] = turn > 0 ? edges[i][k] : -edges[i][k];
    result.unused = 0;
    const bool before_the_eye = corners[0].z > 0 && corners[1].z > 0 && corners[2].z > 0;
    return (before_the_eye && draw_enlarged(corners, turn < 0, result)) || draw_box(corners, result);
}

bool SurfaceTriangles::holds_a_pixel(const glm::dvec2& low, const glm::dvec2& high) const
{
    const glm::dvec2 first = glm::max(glm::ceil(low - 0.5 - slack), low_);
    const glm::dvec2 last = glm::min(glm::floor(high - 0.5 + slack), high_ - 1.0);
    return first.x <= last.x && first.y <= last.y;
}

// Its sides moved outwards; false where that is not to be had.
bool SurfaceTriangles::draw_enlarged(const std::array<SurfacePoint, 3>& corners, bool turned,
                                     SurfaceTriangle& result) const
{
    std::array<glm::dvec2, 3> at;
    double by = 2 * step_;
    for (std::size_t i = 0; i < 3; ++i) {
        at[i] = glm::dvec2(corners[i]) / corners[i].z;
        if (!(std::abs(at[i].x) < range_) || !(std::abs(at[i].y) < range_))
            return false;
        by = std::max({by, rounded_by * std::abs(at[i].x), rounded_by * std::abs(at[i].y)});
    }
    std::array<glm::dvec2, 3> normals; // of the side that starts at each corner, outwards
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 along = at[(i + 1) % 3] - at[i];
        const double length = glm::length(along);
        if (!(length > 0))
            return false;
        normals[i] = glm::dvec2(along.y, -along.x) * ((turned ? -1 : 1) / length);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 sum = normals[i] + normals[(i + 2) % 3];
        const double square = glm::dot(sum, sum); // 2 + 2 cos of the angle between the normals
        const glm::dvec2 move = sum * (2 * by / square);
        if (!(glm::length(move) <= longest_tip))
            return false;
        result.corners[i] = at[i] + move;
        if (!(std::abs(result.corners[i].x) < range_) || !(std::abs(result.corners[i].y) < range_))
            return false;
    }
    return true;
}

// Around the box of what is seen of it; false if that is nothing.
bool SurfaceTriangles::draw_box(const std::array<SurfacePoint, 3>& corners, SurfaceTriangle& result) const
{
    const glm::dvec2 low = low_ - 1.0, high = high_ + 1.0;
    std::vector<SurfacePoint> seen(corners.begin(), corners.end());
    seen = clipped(seen, [&](const SurfacePoint& p) { return p.x - low.x * p.z; });
    seen = clipped(seen, [&](const SurfacePoint& p) { return high.x * p.z - p.x; });
    seen = clipped(seen, [&](const SurfacePoint& p) { return p.y - low.y * p.z; });
    seen = clipped(seen, [&](const SurfacePoint& p) { return high.y * p.z - p.y; });
    glm::dvec2 from = high, to = low;
    for (const SurfacePoint& p : seen) {
        if (!(p.z > 0)) { // at the eye itself
            from = low;
            to = high;
            break;
        }
        from = glm::min(from, glm::dvec2(p) / p.z);
        to = glm::max(to, glm::dvec2(p) / p.z);
    }
    if (!holds_a_pixel(from, to))
        return false;
    from = glm::max(glm::floor(from) - 1.0, low);
    to = glm::min(glm::ceil(to) + 1.0, high);
    // A triangle around a rectangle.
    result.corners = {glm::vec2(from), glm::vec2(2 * to.x - from.x, from.y), glm::vec2(from.x, 2 * to.y - from.y)};
    return true;
}

} // namespace visorder::detail
