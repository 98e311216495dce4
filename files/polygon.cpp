#include "files/polygon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace visorder {

namespace {

/// Twice the signed area of a triangle in the plane.
double area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The corners seen along the axis that is nearest to the polygon's mean normal, counterclockwise.
std::vector<glm::dvec2> flattened(std::span<const PointId> polygon, std::span<const glm::dvec3> points)
{
    glm::dvec3 normal(0);
    const glm::dvec3& origin = points[polygon[0]];
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        normal += glm::cross(points[polygon[i]] - origin, points[polygon[i + 1]] - origin);

    int axis = 0;
    for (int other = 1; other < 3; ++other)
        if (std::abs(normal[other]) > std::abs(normal[axis]))
            axis = other;
    const int x = normal[axis] < 0 ? (axis + 2) % 3 : (axis + 1) % 3;
    const int y = 3 - axis - x;

    std::vector<glm::dvec2> flat;
    for (const PointId point : polygon)
        flat.emplace_back(points[point][x], points[point][y]);
    return flat;
}

/// The corners that are left of a polygon while ears are cut off it.
class EarClipping {
public:
    explicit EarClipping(std::vector<glm::dvec2> corners) : flat_(std::move(corners)), is_ear_(flat_.size())
    {
        for (std::size_t i = 0; i < flat_.size(); ++i)
            remaining_.push_back(i);
        for (std::size_t at = 0; at < remaining_.size(); ++at)
            update(at);
    }

    std::size_t size() const { return remaining_.size(); }

    /// Cuts off a corner; gives it between its neighbours.
    std::array<std::size_t, 3> cut()
    {
        const std::size_t n = remaining_.size();
        // Started at the second corner, so that what stays of a convex polygon keeps its first.
        std::size_t at = 1;
        while (at <= n && !is_ear_[remaining_[at % n]])
            ++at;
        // Without an ear the polygon has no area left or crosses itself; any corner will do.
        at = at > n ? 1 : at % n;
        const std::array triangle{remaining_[(at + n - 1) % n], remaining_[at], remaining_[(at + 1) % n]};
        remaining_.erase(remaining_.begin() + static_cast<std::ptrdiff_t>(at));
        if (remaining_.size() >= 3) {
            update((at + remaining_.size() - 1) % remaining_.size());
            update(at % remaining_.size());
        }
        return triangle;
    }

private:
    /// Finds out whether the corner can be cut off: it points outward, and no other lies in its triangle. Cutting off
    /// another corner changes that of its neighbours alone: in a triangle that holds corners of a simple polygon there
    /// is one that points inward, which is never cut off.
    void update(std::size_t at)
    {
        const std::size_t n = remaining_.size();
        const glm::dvec2& a = flat_[remaining_[(at + n - 1) % n]];
        const glm::dvec2& b = flat_[remaining_[at]];
        const glm::dvec2& c = flat_[remaining_[(at + 1) % n]];
        is_ear_[remaining_[at]] =
            area(a, b, c) > 0 && std::none_of(remaining_.begin(), remaining_.end(), [&](std::size_t corner) {
                const glm::dvec2& p = flat_[corner];
                // Corners may coincide with those of the ear, where the polygon touches itself.
                return p != a && p != b && p != c && area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
            });
    }

    std::vector<glm::dvec2> flat_;
    std::vector<bool> is_ear_; // for each corner of the whole polygon
    std::vector<std::size_t> remaining_;
};

} // namespace

std::vector<std::array<PointId, 3>> triangles_of(std::span<const PointId> polygon, std::span<const glm::dvec3> points)
{
    if (polygon.size() == 3)
        return {{polygon[0], polygon[1], polygon[2]}};
    std::vector<std::array<PointId, 3>> triangles;
    for (EarClipping clipping(flattened(polygon, points)); clipping.size() >= 3;) {
        const auto [a, b, c] = clipping.cut();
        triangles.push_back({polygon[a], polygon[b], polygon[c]});
    }
    return triangles;
}

} // namespace visorder
