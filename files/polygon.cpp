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

/// Whether corner `at` of the remaining ones can be cut off: it points outward, and no other corner lies in its
/// triangle.
bool is_ear(const std::vector<std::size_t>& remaining, std::size_t at, const std::vector<glm::dvec2>& flat)
{
    const std::size_t n = remaining.size();
    const glm::dvec2& a = flat[remaining[(at + n - 1) % n]];
    const glm::dvec2& b = flat[remaining[at]];
    const glm::dvec2& c = flat[remaining[(at + 1) % n]];
    if (!(area(a, b, c) > 0))
        return false;
    return std::none_of(remaining.begin(), remaining.end(), [&](std::size_t corner) {
        const glm::dvec2& p = flat[corner];
        // Corners may coincide with those of the ear, where the polygon touches itself.
        return p != a && p != b && p != c && area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
    });
}

} // namespace

std::vector<std::array<PointId, 3>> triangles_of(std::span<const PointId> polygon, std::span<const glm::dvec3> points)
{
    std::vector<std::array<PointId, 3>> triangles;
    if (polygon.size() == 3)
        return {{polygon[0], polygon[1], polygon[2]}};

    const std::vector<glm::dvec2> flat = flattened(polygon, points);
    std::vector<std::size_t> remaining;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        remaining.push_back(i);

    while (remaining.size() >= 3) {
        // Started at the second corner, so that what stays of a convex polygon keeps its first.
        std::size_t ear = 1;
        while (ear <= remaining.size() && !is_ear(remaining, ear % remaining.size(), flat))
            ++ear;
        // Without an ear the polygon has no area left or crosses itself; any corner will do.
        ear = ear > remaining.size() ? 1 : ear % remaining.size();
        const std::size_t n = remaining.size();
        triangles.push_back(
            {polygon[remaining[(ear + n - 1) % n]], polygon[remaining[ear]], polygon[remaining[(ear + 1) % n]]});
        remaining.erase(remaining.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
}

} // namespace visorder
