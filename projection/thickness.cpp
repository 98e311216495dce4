#include "projection/thickness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace visorder::detail {

namespace {

// The gradient of r -> cross(r, e).
glm::dvec2 across(const glm::dvec2& e)
{
    return {e.y, -e.x};
}

glm::dvec2 flat(const glm::dvec3& p)
{
    return {p.x, p.y};
}

// Of the three outer points of a triangle, at the inner one.
std::array<double, 3> shares_at_inner(const VisibleCell& cell)
{
    const double whole = 1 / cell.areas[0];
    return {cell.areas[1] * whole, cell.areas[2] * whole, cell.areas[3] * whole};
}

// Where the edges of a quad cross, as a share of the way along each.
struct Crossing {
    double along_first, along_second;
};

Crossing crossing_of(const VisibleCell& cell)
{
    return {cell.areas[1] / (cell.areas[0] + cell.areas[1]), cell.areas[3] / (cell.areas[2] + cell.areas[3])};
}

double mix(double a, double b, double share)
{
    return a + share * (b - a);
}

// Twice the area of a triangle with a narrow face at its side from a to b, if that is as wide as the least.
double widened(double area, const glm::dvec2& a, const glm::dvec2& b, double least_width)
{
    return least_width == 0 ? area : std::max(area, least_width * glm::length(b - a));
}

void measure_triangle(Thickness& t, const VisibleCell& cell)
{
    // The largest share is at least a third: what is divided by it does not grow.
    const auto largest =
        static_cast<std::size_t>(std::max_element(cell.areas.begin() + 1, cell.areas.end()) - cell.areas.begin());
    const std::size_t next = largest % 3 + 1;
    const std::size_t last = next % 3 + 1;
    t.outer = {static_cast<std::uint8_t>(next), static_cast<std::uint8_t>(last), static_cast<std::uint8_t>(largest)};
    const glm::dvec2 at_next = flat(cell.at[next]);
    const glm::dvec2 at_last = flat(cell.at[last]);
    const glm::dvec2 at_largest = flat(cell.at[largest]);
    const double area1 = widened(cell.areas[next], at_last, at_largest, cell.least_width);
    const double area2 = widened(cell.areas[last], at_largest, at_next, cell.least_width);
    const double turn = cell.counterclockwise ? 1 : -1;
    const double whole = 1 / cell.areas[0];
    t.shares = {area1 * whole, area2 * whole, cell.areas[largest] * whole};
    t.slope1 = across(at_largest - at_last) * (turn / area1);
    t.slope2 = across(at_next - at_largest) * (turn / area2);
    t.first1 = 0;
    t.third = {-area1 / cell.areas[largest], -area2 / cell.areas[largest]};
    t.opposite = 0;
    t.swapped = !cell.inner_behind;
}

void measure_quad(Thickness& t, const VisibleCell& cell)
{
    const glm::dvec2 nearer = flat(cell.at[1]) - flat(cell.at[0]);
    const glm::dvec2 farther = flat(cell.at[3]) - flat(cell.at[2]);
    const double turn = cell.counterclockwise ? 1 : -1;
    const Crossing crossing = crossing_of(cell);
    t.along_first = crossing.along_first;
    t.along_second = crossing.along_second;
    t.slope1 = across(farther) * (-turn / cell.areas[1]);
    t.slope2 = across(nearer) * (turn / cell.areas[3]);
    t.first1 = 1;
    // Each tent at the other end of its edge is the less, the closer that is to the other edge's line.
    const double less1 = widened(cell.areas[0], glm::dvec2(0), farther, cell.least_width);
    const double less2 = widened(cell.areas[2], glm::dvec2(0), nearer, cell.least_width);
    t.third = {-cell.areas[1] / less1, 0};
    t.opposite = -cell.areas[3] / less2;
    t.swapped = false;
}

} // namespace

CellValues values_of(const VisibleCell& cell, const ScaledScalars& scalars, double inverse_distance)
{
    CellValues values{};
    for (std::size_t i = 0; i < 4; ++i) {
        values.depth[i] = cell.at[i].z;
        values.scalar[i] = scalars[cell.points[i]] * (1 - values.depth[i] * inverse_distance);
    }
    return values;
}

ThickPoint thick_point(const VisibleCell& cell, const CellValues& values)
{
    ThickPoint point{};
    point.at = flat(cell.at[0]);
    if (cell.kind == SilhouetteClass::triangle) {
        const std::array<double, 3> shares = shares_at_inner(cell);
        point.front_shares = {1, 0, 0, 0};
        point.back_shares = {0, shares[0], shares[1], shares[2]};
        if (cell.inner_behind)
            std::swap(point.front_shares, point.back_shares);
    } else {
        const Crossing crossing = crossing_of(cell);
        point.at += crossing.along_first * (flat(cell.at[1]) - point.at);
        point.front_shares = {1 - crossing.along_first, crossing.along_first, 0, 0};
        point.back_shares = {0, 0, 1 - crossing.along_second, crossing.along_second};
    }
    for (std::size_t i = 0; i < 4; ++i) {
        point.front_depth += point.front_shares[i] * values.depth[i];
        point.back_depth += point.back_shares[i] * values.depth[i];
        point.front_scalar += point.front_shares[i] * values.scalar[i];
        point.back_scalar += point.back_shares[i] * values.scalar[i];
    }
    return point;
}

Thickness thickness_of(const VisibleCell& cell, const CellValues& values)
{
    Thickness t{};
    t.kind = cell.kind;
    if (cell.kind == SilhouetteClass::triangle)
        measure_triangle(t, cell);
    else
        measure_quad(t, cell);
    t.depth = t.linear(values.depth);
    t.scalar = t.linear(values.scalar);
    return t;
}

double Thickness::at(const glm::dvec2& r) const
{
    const double t1 = first1 + glm::dot(slope1, r);
    const double t2 = glm::dot(slope2, r);
    const double t3 = third.x * t1 + third.y * t2;
    return kind == SilhouetteClass::triangle ? 1 - std::max({t1, t2, t3})
                                             : 1 - std::max(t2, opposite * t2) - std::max(t1, t3);
}

Thickness::Linear Thickness::linear(const std::array<double, 4>& value) const
{
    if (kind == SilhouetteClass::triangle) {
        // An outer point's share of a place is 1 - its tent, of what it is at the inner point.
        const double last = value[outer[2]];
        const double along1 = shares[0] * (last - value[outer[0]]);
        const double along2 = shares[1] * (last - value[outer[1]]);
        const double face = last - along1 - along2;
        return {face, along1, along2, value[0] - face};
    }
    const double near = mix(value[0], value[1], along_first);
    const double far = mix(value[2], value[3], along_second);
    return {near, value[0] - near, value[2] - far, far - near};
}

std::array<glm::vec4, 5> Thickness::interpolate(const std::array<glm::vec4, 4>& at_points) const
{
    if (kind == SilhouetteClass::triangle) {
        const glm::vec4& last = at_points[outer[2]];
        const glm::vec4 along1 = static_cast<float>(shares[0]) * (last - at_points[outer[0]]);
        const glm::vec4 along2 = static_cast<float>(shares[1]) * (last - at_points[outer[1]]);
        const glm::vec4 face = last - along1 - along2;
        const glm::vec4 thick = 0.5F * (at_points[0] + face);
        return {thick, along1, along2, glm::vec4(0), face - thick};
    }
    const glm::vec4 first = at_points[1] - at_points[0];
    const glm::vec4 second = at_points[3] - at_points[2];
    const glm::vec4 near = at_points[0] + static_cast<float>(along_first) * first;
    const glm::vec4 far = at_points[2] + static_cast<float>(along_second) * second;
    const glm::vec4 thick = 0.5F * (near + far);
    // Along the nearer edge t1 runs from 1 to 1 / third.x, and along the farther one t2 from 1 to 1 / opposite; g or m
    // is 1 at either end.
    const glm::vec4 along1 = first * static_cast<float>(1 / (1 / third.x - 1));
    const glm::vec4 along2 = second * static_cast<float>(1 / (1 / opposite - 1));
    return {thick, along1, along2, at_points[2] - thick - along2, at_points[0] - thick - along1};
}

} // namespace visorder::detail
