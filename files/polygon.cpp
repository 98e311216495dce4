#include "files/polygon.h"

#include "files/plane_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <set>

namespace visorder::detail {

namespace {

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
    explicit EarClipping(std::vector<glm::dvec2> corners)
        : flat_(std::move(corners)), points_(flat_), before_(flat_.size()), after_(flat_.size()), size_(flat_.size())
    {
        for (std::size_t i = 0; i < size_; ++i) {
            before_[i] = (i + size_ - 1) % size_;
            after_[i] = (i + 1) % size_;
        }
        for (std::size_t i = 0; i < size_; ++i)
            update(i);
    }

    std::size_t size() const { return size_; }

    /// Cuts off a corner; gives it between its neighbours.
    std::array<std::size_t, 3> cut()
    {
        const std::size_t corner = next();
        const std::array triangle{before_[corner], corner, after_[corner]};
        ears_.erase(corner);
        points_.remove(corner);
        after_[before_[corner]] = after_[corner];
        before_[after_[corner]] = before_[corner];
        if (corner == first_)
            first_ = after_[corner];
        if (--size_ >= 3) {
            update(before_[corner]);
            update(after_[corner]);
        }
        return triangle;
    }

private:
    /// The first ear after the first corner, so that what stays of a convex polygon keeps that.
    std::size_t next() const
    {
        const auto ear = ears_.upper_bound(first_);
        if (ear != ears_.end())
            return *ear;
        // Without an ear the polygon has no area left or crosses itself; any corner will do.
        return ears_.empty() ? after_[first_] : first_;
    }

    /// Finds out whether the corner can be cut off: it points outward, and no other lies in its triangle. Cutting off
    /// another corner changes that of its neighbours alone: in a triangle that holds corners of a simple polygon there
    /// is one that points inward, which is never cut off.
    void update(std::size_t corner)
    {
        const glm::dvec2& a = flat_[before_[corner]];
        const glm::dvec2& b = flat_[corner];
        const glm::dvec2& c = flat_[after_[corner]];
        // Corners may coincide with those of the ear, where the polygon touches itself.
        if (doubled_area(a, b, c) > 0 && !points_.any_in(a, b, c))
            ears_.insert(corner);
        else
            ears_.erase(corner);
    }

    std::vector<glm::dvec2> flat_;
    PlanePoints points_; // of the corners that are left
    std::vector<std::size_t> before_;
    std::vector<std::size_t> after_;
    std::size_t size_;
    std::size_t first_ = 0;
    std::set<std::size_t> ears_;
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

} // namespace visorder::detail
