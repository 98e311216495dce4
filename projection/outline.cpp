#include "projection/outline.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace visorder {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

struct Polygon {
    std::array<glm::dvec2, 4> corner; // in a round
    std::size_t count;

    const glm::dvec2& after(std::size_t i) const { return corner[i + 1 == count ? 0 : i + 1]; }
};

// In lattice steps.
Polygon polygon_of(const VisibleCell& cell, const RasterLattice& lattice)
{
    const auto at = [&](std::size_t i) {
        return glm::dvec2(cell.at[i].x, cell.at[i].y) * static_cast<double>(lattice.steps);
    };
    if (cell.kind == SilhouetteClass::triangle)
        return {{at(1), at(2), at(3)}, 3};
    return {{at(0), at(2), at(1), at(3)}, 4};
}

glm::ivec2 rounded(const glm::dvec2& place)
{
    return {std::lrint(place.x), std::lrint(place.y)};
}

// A corner that is rounded moves by 0.71 steps at most.
constexpr double margin = 1;

struct MovedCorners {
    std::array<glm::ivec2, 4> at;
    std::size_t count;
};

// Every side moves outwards by the margin; corners are where they meet. None where one would go far.
std::optional<MovedCorners> moved(const Polygon& polygon)
{
    constexpr double farthest = 1024; // steps
    constexpr double least = 2 * margin * margin / (farthest * farthest);
    double area = 0;
    for (std::size_t i = 0; i < polygon.count; ++i)
        area += cross(polygon.corner[i] - polygon.corner[0], polygon.after(i) - polygon.corner[0]);
    std::array<glm::dvec2, 4> outwards{};
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec2 side = polygon.after(i) - polygon.corner[i];
        outwards[i] = glm::dvec2(side.y, -side.x) * (std::copysign(1.0, area) / glm::length(side));
    }
    MovedCorners result{{}, polygon.count};
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec2& before = outwards[i == 0 ? polygon.count - 1 : i - 1];
        const double both = 1 + glm::dot(before, outwards[i]);
        // Written so that a side without length, too, has no corners.
        if (!(both > least))
            return std::nullopt;
        result.at[i] = rounded(polygon.corner[i] + (before + outwards[i]) * (margin / both));
    }
    return result;
}

bool within(const glm::ivec2& place, const RasterLattice& lattice)
{
    const int range = lattice.half_range * lattice.steps;
    return std::abs(place.x) < range && std::abs(place.y) < range;
}

// A triangle around a quad that is little larger, if there is one: the sides next to one of the quad's sides meet
// beyond it. One triangle in place of two.
std::optional<Polygon> triangle_around(const Polygon& quad)
{
    constexpr double most_added = 0.6;   // of the quad's area
    constexpr double farthest_way = 100; // of a side
    const auto& v = quad.corner;
    const double area = std::abs(cross(v[2] - v[0], v[3] - v[1]));
    double least = most_added * area;
    std::size_t best = 4;
    double best_way = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 side = v[(i + 1) % 4] - v[i];
        const glm::dvec2 before = v[i] - v[(i + 3) % 4];
        const glm::dvec2 after = v[(i + 1) % 4] - v[(i + 2) % 4];
        const double turn = cross(before, after);
        if (turn == 0)
            continue;
        const double way = cross(side, after) / turn;
        const double added = std::abs(cross(side, before)) * way;
        // The sides meet beyond this one, and not on the quad's other side.
        if (way > 0 && way < farthest_way && cross(side, before) / turn > 0 && added < least) {
            least = added;
            best = i;
            best_way = way;
        }
    }
    if (best == 4)
        return std::nullopt;
    const glm::dvec2 corner = v[best] + best_way * (v[best] - v[(best + 3) % 4]);
    return Polygon{{corner, v[(best + 2) % 4], v[(best + 3) % 4]}, 3};
}

// Two triangles that are a rectangle along the longest line between two corners: for what is so narrow that its corners
// would move far.
Outline rectangle_around(const Polygon& polygon)
{
    glm::dvec2 along(1, 0);
    double longest = 0;
    for (std::size_t i = 0; i < polygon.count; ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (const double length = glm::length(polygon.corner[i] - polygon.corner[k]); length > longest) {
                longest = length;
                along = (polygon.corner[i] - polygon.corner[k]) / length;
            }
    const glm::dvec2 across(-along.y, along.x);
    const glm::dvec2& origin = polygon.corner[0];
    glm::dvec2 low(0);
    glm::dvec2 high(0);
    for (const glm::dvec2& corner : std::span(polygon.corner).first(polygon.count)) {
        const glm::dvec2 place(glm::dot(along, corner - origin), glm::dot(across, corner - origin));
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    low -= margin;
    high += margin;
    const auto at = [&](double x, double y) { return rounded(origin + along * x + across * y); };
    Outline outline;
    outline.add(at(low.x, low.y), at(high.x, low.y), at(high.x, high.y));
    outline.add(at(low.x, low.y), at(high.x, high.y), at(low.x, high.y));
    return outline;
}

} // namespace

Outline outline_of(const VisibleCell& cell, const RasterLattice& lattice)
{
    const Polygon polygon = polygon_of(cell, lattice);
    Outline outline;
    if (polygon.count == 4)
        if (const auto around = triangle_around(polygon))
            if (const auto corners = moved(*around); corners && within(corners->at[0], lattice)) {
                outline.add(corners->at[0], corners->at[1], corners->at[2]);
                return outline;
            }
    const auto corners = moved(polygon);
    if (!corners)
        return rectangle_around(polygon);
    outline.add(corners->at[0], corners->at[1], corners->at[2]);
    if (corners->count == 4)
        outline.add(corners->at[0], corners->at[2], corners->at[3]);
    return outline;
}

Outline fan_of(const VisibleCell& cell, const glm::dvec2& thickest, const RasterLattice& lattice)
{
    const Polygon polygon = polygon_of(cell, lattice);
    const auto corners = moved(polygon);
    if (!corners)
        return rectangle_around(polygon);
    Outline outline;
    const glm::ivec2 middle = rounded(thickest * static_cast<double>(lattice.steps));
    for (std::size_t i = 0; i < corners->count; ++i)
        outline.add(middle, corners->at[i], corners->at[(i + 1) % corners->count]);
    return outline;
}

} // namespace visorder
