#include "projection/thickness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace visorder {

namespace {

constexpr double tiny = 1e-12; // pixels

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

// The gradient of r -> cross(r, e).
glm::dvec2 across(const glm::dvec2& e)
{
    return {e.y, -e.x};
}

struct Corners {
    glm::dvec2 second, third, fourth; // from the first, in pixels
};

glm::dvec2 flat(const glm::dvec3& p)
{
    return {p.x, p.y};
}

Corners corners_of(const VisibleCell& cell)
{
    const glm::dvec2 first = flat(cell.at[0]);
    return {flat(cell.at[1]) - first, flat(cell.at[2]) - first, flat(cell.at[3]) - first};
}

// Of the three outer points' areas with the inner one, in it.
std::array<double, 3> shares_at_inner(const Corners& c)
{
    const double first = cross(c.third, c.fourth);
    const double second = cross(c.fourth, c.second);
    const double third = cross(c.second, c.third);
    const double whole = first + second + third;
    return {first / whole, second / whole, third / whole};
}

// Where the edges of a quad cross, as a share of the way along each.
struct Crossing {
    double along_first, along_second;
};

Crossing crossing_of(const Corners& c)
{
    const glm::dvec2 farther = c.fourth - c.third;
    const double whole = cross(c.second, farther);
    return {cross(c.third, farther) / whole, cross(c.third, c.second) / whole};
}

double mix(double a, double b, double share)
{
    return a + share * (b - a);
}

glm::vec4 combined(const std::array<glm::vec4, 4>& values, const std::array<double, 4>& shares)
{
    glm::vec4 sum(0);
    for (std::size_t i = 0; i < 4; ++i)
        sum += static_cast<float>(shares[i]) * values[i];
    return sum;
}

double length_at(const TriangleSources& from, const ThickPoint& point)
{
    const Screen& screen = *from.screen;
    const double inverse = screen.inverse_distance();
    return (point.back_depth - point.front_depth) /
           ((1 - point.front_depth * inverse) * (1 - point.back_depth * inverse)) *
           glm::length(screen.rays() * glm::dvec3(point.at, 1));
}

void measure_quad(Thickness& t, const Corners& c, double least_width)
{
    const glm::dvec2 farther = c.fourth - c.third;
    const Crossing crossing = crossing_of(c);
    // Coordinate 1 is 1 at the first point and 0 on the farther edge; 2 is 1 at the third and 0 on the nearer edge.
    t.k1_exact = -across(farther) / cross(c.third, farther);
    t.k2_exact = across(c.second) / cross(c.third, c.second);
    const double least = std::max(least_width, tiny);
    t.opposite1 = -std::max((1 - crossing.along_first) / crossing.along_first, least * glm::length(t.k1_exact));
    t.opposite2 = -std::max((1 - crossing.along_second) / crossing.along_second, least * glm::length(t.k2_exact));
    t.along_first = crossing.along_first;
    t.along_second = crossing.along_second;
    t.k1 = glm::vec2(t.k1_exact);
    t.k2 = glm::vec2(t.k2_exact);
    t.k3 = glm::vec2(1 / t.opposite1, 1 / t.opposite2);
}

} // namespace

CellValues values_of(const VisibleCell& cell, std::span<const float> scalars, double inverse_distance)
{
    CellValues values{};
    for (std::size_t i = 0; i < 4; ++i) {
        values.depth[i] = cell.at[i].z;
        values.scalar[i] = static_cast<double>(scalars[cell.points[i]]) * (1 - values.depth[i] * inverse_distance);
    }
    return values;
}

ThickPoint thick_point(const VisibleCell& cell, const CellValues& values)
{
    const Corners c = corners_of(cell);
    ThickPoint point{};
    point.at = flat(cell.at[0]);
    if (cell.kind == SilhouetteClass::triangle) {
        const std::array<double, 3> shares = shares_at_inner(c);
        point.front_shares = {1, 0, 0, 0};
        point.back_shares = {0, shares[0], shares[1], shares[2]};
        if (cell.inner_behind)
            std::swap(point.front_shares, point.back_shares);
    } else {
        const Crossing crossing = crossing_of(c);
        point.at += crossing.along_first * c.second;
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

CellOptics optics_of(const TriangleSources& from, const VisibleCell& cell, const ThickPoint& point)
{
    CellOptics optics{};
    for (std::size_t i = 0; i < 4; ++i)
        optics.at_points[i] = from.optics[cell.points[i]];
    optics.at_thickest =
        0.5F * (combined(optics.at_points, point.front_shares) + combined(optics.at_points, point.back_shares));
    if (from.opacity_at_thickest) {
        for (glm::vec4& o : optics.at_points)
            o.w = 0;
        optics.at_thickest.w =
            static_cast<float>(-std::expm1(-static_cast<double>(optics.at_thickest.w) * length_at(from, point)));
    }
    return optics;
}

Thickness thickness_of(const VisibleCell& cell, const CellValues& values)
{
    const Corners c = corners_of(cell);
    Thickness t{};
    t.kind = cell.kind;
    if (cell.kind == SilhouetteClass::triangle) {
        t.inner_shares = shares_at_inner(c);
        const double area1 = cross(c.second, c.third);
        const double area2 = cross(c.third, c.fourth);
        const double area3 = cross(c.fourth, c.second);
        const double whole = area1 + area2 + area3;
        t.share_slopes = {across(c.third - c.fourth) / whole, across(c.fourth - c.second) / whole,
                          across(c.second - c.third) / whole};
        // One at the far edge of each triangle around the inner point.
        const auto slope = [&](const glm::dvec2& a, const glm::dvec2& b, double area) {
            const glm::dvec2 edge = b - a;
            const double least = std::max(cell.least_width, tiny) * glm::length(edge);
            const double wide = std::max(whole > 0 ? area : -area, least);
            return wide == 0 ? glm::vec2(0) : glm::vec2(across(edge) / std::copysign(wide, whole));
        };
        t.k1 = slope(c.second, c.third, area1);
        t.k2 = slope(c.third, c.fourth, area2);
        t.k3 = slope(c.fourth, c.second, area3);
        t.swapped = !cell.inner_behind;
    } else {
        measure_quad(t, c, cell.least_width);
    }
    t.depth = t.linear(values.depth);
    t.scalar = t.linear(values.scalar);
    return t;
}
Thickness::Linear Thickness::linear(const std::array<double, 4>& value) const
{
    if (kind == SilhouetteClass::triangle) {
        double face = 0;
        glm::dvec2 slope(0);
        for (std::size_t i = 0; i < 3; ++i) {
            face += inner_shares[i] * value[i + 1];
            slope += value[i + 1] * share_slopes[i];
        }
        return {glm::vec2(slope), static_cast<float>(face), static_cast<float>(value[0] - face)};
    }
    const double near = mix(value[0], value[1], along_first);
    const double far = mix(value[2], value[3], along_second);
    return {glm::vec2((value[0] - near) * k1_exact + (value[2] - far) * k2_exact), static_cast<float>(value[0]),
            static_cast<float>(far - near)};
}

std::array<glm::vec4, 5> Thickness::interpolate(const std::array<glm::vec4, 4>& at_points,
                                                const glm::vec4& at_thickest) const
{
    if (kind == SilhouetteClass::triangle) {
        glm::vec4 face(0);
        glm::vec4 slope_x(0);
        glm::vec4 slope_y(0);
        for (std::size_t i = 0; i < 3; ++i) {
            face += static_cast<float>(inner_shares[i]) * at_points[i + 1];
            slope_x += static_cast<float>(share_slopes[i].x) * at_points[i + 1];
            slope_y += static_cast<float>(share_slopes[i].y) * at_points[i + 1];
        }
        return {at_thickest, slope_x, slope_y, glm::vec4(0), face - at_thickest};
    }
    // Along the nearer edge t1 runs from 1 to opposite1, and along the farther one t2 from 1 to opposite2; g or m is 1
    // at either end.
    const glm::vec4 slope1 = (at_points[0] - at_points[1]) / static_cast<float>(1 - opposite1);
    const glm::vec4 slope2 = (at_points[2] - at_points[3]) / static_cast<float>(1 - opposite2);
    return {at_thickest + slope1, static_cast<float>(k1_exact.x) * slope1 + static_cast<float>(k2_exact.x) * slope2,
            static_cast<float>(k1_exact.y) * slope1 + static_cast<float>(k2_exact.y) * slope2,
            at_points[2] - at_thickest - slope2, at_points[0] - at_thickest - slope1};
}

} // namespace visorder
