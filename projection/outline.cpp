#include "projection/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace visorder::detail {

namespace {

// std::lrint and std::floor are function calls. What is far beyond the lattice may be off by one.
glm::ivec2 rounded(const glm::dvec2& place)
{
    constexpr int up = 1 << 24; // so that what is cut off is never negative
    return {static_cast<int>(place.x + (up + 0.5)) - up, static_cast<int>(place.y + (up + 0.5)) - up};
}

// A convex polygon, in lattice steps.
template <std::size_t count>
struct Polygon {
    std::array<glm::dvec2, count> corner; // in a round
    std::array<double, count> areas;      // at each corner, of the parallelogram of its sides
};
using Triangle = Polygon<3>;
using Quad = Polygon<4>;

template <std::size_t count>
Polygon<count> polygon(const VisibleCell& cell, const RasterLattice& lattice,
                       const std::array<std::size_t, count>& points, const std::array<std::size_t, count>& areas)
{
    const double steps = lattice.steps;
    Polygon<count> result;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3& at = cell.at[points[i]];
        result.corner[i] = glm::dvec2(at.x * steps, at.y * steps);
        result.areas[i] = cell.areas[areas[i]] * (steps * steps);
    }
    return result;
}

Triangle triangle_of(const VisibleCell& cell, const RasterLattice& lattice)
{
    return polygon<3>(cell, lattice, {1, 2, 3}, {0, 0, 0});
}

Quad quad_of(const VisibleCell& cell, const RasterLattice& lattice)
{
    return polygon<4>(cell, lattice, {0, 2, 1, 3}, {1, 3, 0, 2});
}

// A corner that is rounded moves by 0.71 steps at most.
constexpr double margin = 1;

// Every side moves outwards by the margin or a little more; corners are where they meet. False where one would go far.
template <std::size_t count>
bool move(const Polygon<count>& polygon, std::array<glm::ivec2, count>& moved)
{
    constexpr double farthest = 1024; // steps
    std::array<glm::dvec2, count> side;
    std::array<double, count> way; // outwards, times the side's length
    std::array<double, count> inverse;
    for (std::size_t i = 0; i < count; ++i) {
        side[i] = polygon.corner[(i + 1) % count] - polygon.corner[i];
        way[i] = margin * (std::abs(side[i].x) + std::abs(side[i].y));
        inverse[i] = count == 3 && i > 0 ? inverse[0] : 1 / polygon.areas[i];
    }
    std::array<glm::dvec2, count> off;
    bool near = true;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t before = (i + count - 1) % count;
        off[i] = (way[i] * side[before] - way[before] * side[i]) * inverse[i];
        // Written so that a side without length, too, goes far.
        near = near && std::abs(off[i].x) < farthest && std::abs(off[i].y) < farthest;
    }
    if (!near)
        return false;
    for (std::size_t i = 0; i < count; ++i)
        moved[i] = rounded(polygon.corner[i] + off[i]);
    return true;
}

bool within(const glm::ivec2& place, const RasterLattice& lattice)
{
    const int range = lattice.half_range * lattice.steps;
    return std::abs(place.x) < range && std::abs(place.y) < range;
}

// A triangle around a quad that is little larger, if there is one: the sides next to one of the quad's sides meet
// beyond it. One triangle in place of two.
std::optional<Triangle> triangle_around(const Quad& quad, double most_added)
{
    constexpr double farthest_way = 100; // of a side
    const auto& a = quad.areas;
    const double area = a[0] + a[2];
    double least = 2 * most_added;
    std::size_t best = 4;
    double best_way = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        // Beyond the side to the next corner, if they come closer there.
        const std::size_t next = (i + 1) % 4;
        const double closer = a[(i + 3) % 4] - a[i];
        if (!(a[i] * a[next] < least * closer && a[next] < farthest_way * closer))
            continue;
        least = a[i] * a[next] / closer;
        best_way = a[next] / closer;
        best = i;
    }
    if (best == 4)
        return std::nullopt;
    const auto& v = quad.corner;
    const glm::dvec2 corner = v[best] + best_way * (v[best] - v[(best + 3) % 4]);
    const double whole = area + least;
    return Triangle{{corner, v[(best + 2) % 4], v[(best + 3) % 4]}, {whole, whole, whole}};
}

// Fragments take a row that is interpolated over their triangle (see place_vertex_shader). Single precision has it
// within half a pixel of a triangle that is l pixels long, along either axis, and l^2 / 2^19 high. Half of that height;
// in lattice steps, as `longest`.
double margin_for_rows(double longest, const RasterLattice& lattice)
{
    return longest * longest * 0x1p-20 / lattice.steps;
}

// Two triangles that are a rectangle along the longest line between two corners, and reaches so far beyond them: for
// what is so narrow that its corners would move far.
Outline rectangle_around(std::span<const glm::dvec2> corners, double beyond)
{
    glm::dvec2 along(1, 0);
    double longest = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (const double length = glm::length(corners[i] - corners[k]); length > longest) {
                longest = length;
                along = (corners[i] - corners[k]) / length;
            }
    const glm::dvec2 across(-along.y, along.x);
    const glm::dvec2& origin = corners[0];
    glm::dvec2 low(0);
    glm::dvec2 high(0);
    for (const glm::dvec2& corner : corners) {
        const glm::dvec2 place(glm::dot(along, corner - origin), glm::dot(across, corner - origin));
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    low -= beyond;
    high += beyond;
    const auto at = [&](double x, double y) { return rounded(origin + along * x + across * y); };
    Outline outline;
    outline.add(at(low.x, low.y), at(high.x, low.y), at(high.x, high.y));
    outline.add(at(low.x, low.y), at(high.x, high.y), at(low.x, high.y));
    return outline;
}

// Pixels: to draw as many more takes about as long as another triangle.
constexpr double most_added = 40;

} // namespace

Outline outline_of(const VisibleCell& cell, const RasterLattice& lattice)
{
    Outline outline;
    const double longest = std::max(cell.high.x - cell.low.x, cell.high.y - cell.low.y);
    const double for_rows = margin_for_rows(longest, lattice);
    const double widest_margin = std::max(margin, for_rows);
    // What is moved outwards is twice the margin high.
    const double least_area = for_rows > margin ? 2 * for_rows * longest : 0;
    std::array<glm::ivec2, 3> corners;
    if (cell.kind == SilhouetteClass::triangle) {
        const Triangle triangle = triangle_of(cell, lattice);
        if (triangle.areas[0] < least_area || !move(triangle, corners))
            return rectangle_around(triangle.corner, widest_margin);
        outline.add(corners[0], corners[1], corners[2]);
        return outline;
    }
    const Quad quad = quad_of(cell, lattice);
    // Of the two triangles that it would be drawn as.
    if (std::min(quad.areas[1], quad.areas[3]) < least_area)
        return rectangle_around(quad.corner, widest_margin);
    if (const auto around = triangle_around(quad, most_added * lattice.steps * lattice.steps))
        if (move(*around, corners) && within(corners[0], lattice)) {
            outline.add(corners[0], corners[1], corners[2]);
            return outline;
        }
    std::array<glm::ivec2, 4> of_quad;
    if (!move(quad, of_quad))
        return rectangle_around(quad.corner, widest_margin);
    outline.add(of_quad[0], of_quad[1], of_quad[2]);
    outline.add(of_quad[0], of_quad[2], of_quad[3]);
    return outline;
}

namespace {

template <std::size_t count>
Outline fan_around(const Polygon<count>& polygon, const glm::dvec2& thickest)
{
    std::array<glm::ivec2, count> corners;
    if (!move(polygon, corners))
        return rectangle_around(polygon.corner, margin);
    const glm::ivec2 middle = rounded(thickest);
    Outline outline;
    for (std::size_t i = 0; i < count; ++i)
        outline.add(middle, corners[i], corners[(i + 1) % count]);
    return outline;
}

} // namespace

Outline fan_of(const VisibleCell& cell, const glm::dvec2& thickest, const RasterLattice& lattice)
{
    const glm::dvec2 middle = thickest * static_cast<double>(lattice.steps);
    return cell.kind == SilhouetteClass::triangle ? fan_around(triangle_of(cell, lattice), middle)
                                                  : fan_around(quad_of(cell, lattice), middle);
}

} // namespace visorder::detail
