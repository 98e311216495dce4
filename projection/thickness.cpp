#include "projection/thickness.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace visorder {

namespace {

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

Corners corners_of(const VisibleCell& cell, double pixels_a_step)
{
    return {glm::dvec2(cell.at[1] - cell.at[0]) * pixels_a_step, glm::dvec2(cell.at[2] - cell.at[0]) * pixels_a_step,
            glm::dvec2(cell.at[3] - cell.at[0]) * pixels_a_step};
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

double length_at(const TriangleSources& from, const VisibleCell& cell, const ThickPoint& point)
{
    const Screen& screen = *from.screen;
    const double inverse = screen.inverse_distance();
    const glm::dvec2 pixel = glm::dvec2(cell.at[0]) / static_cast<double>(from.lattice.steps) + point.at;
    return (point.back_depth - point.front_depth) /
           ((1 - point.front_depth * inverse) * (1 - point.back_depth * inverse)) *
           glm::length(screen.rays() * glm::dvec3(pixel, 1));
}

} // namespace

CellValues values_of(const VisibleCell& cell, const ScreenPoints& points, double inverse_distance)
{
    CellValues values{};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec4& p = points.exact[cell.points[i]];
        values.depth[i] = p.z;
        values.scalar[i] = p.w * (1 - values.depth[i] * inverse_distance);
    }
    return values;
}

ThickPoint thick_point(const VisibleCell& cell, const CellValues& values, double pixels_a_step)
{
    const Corners c = corners_of(cell, pixels_a_step);
    ThickPoint point{};
    if (cell.kind == SilhouetteClass::triangle) {
        const std::array<double, 3> shares = shares_at_inner(c);
        point.front_shares = {1, 0, 0, 0};
        point.back_shares = {0, shares[0], shares[1], shares[2]};
        if (cell.inner_behind)
            std::swap(point.front_shares, point.back_shares);
    } else {
        const Crossing crossing = crossing_of(c);
        point.at = crossing.along_first * c.second;
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
            static_cast<float>(-std::expm1(-static_cast<double>(optics.at_thickest.w) * length_at(from, cell, point)));
    }
    return optics;
}

Thickness thickness_of(const VisibleCell& cell, const CellValues& values, double pixels_a_step)
{
    const Corners c = corners_of(cell, pixels_a_step);
    const auto& depth = values.depth;
    const auto& scalar = values.scalar;
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
        // One at the far edge of each triangle around the inner point; a triangle without area holds no pixel.
        const auto slope = [](const glm::dvec2& a, const glm::dvec2& b, double area) {
            return area == 0 ? glm::vec2(0) : glm::vec2(across(b - a) / area);
        };
        t.k1 = slope(c.second, c.third, area1);
        t.k2 = slope(c.third, c.fourth, area2);
        t.k3 = slope(c.fourth, c.second, area3);
        double face_depth = 0;
        double face_scalar = 0;
        glm::dvec2 depth_slope(0);
        glm::dvec2 scalar_slope(0);
        for (std::size_t i = 0; i < 3; ++i) {
            face_depth += t.inner_shares[i] * depth[i + 1];
            face_scalar += t.inner_shares[i] * scalar[i + 1];
            depth_slope += depth[i + 1] * t.share_slopes[i];
            scalar_slope += scalar[i + 1] * t.share_slopes[i];
        }
        t.depth_slope = glm::vec2(depth_slope);
        t.scalar_slope = glm::vec2(scalar_slope);
        t.depth_base = static_cast<float>(face_depth);
        t.scalar_base = static_cast<float>(face_scalar);
        t.depth_rise = static_cast<float>(depth[0] - face_depth);
        t.scalar_rise = static_cast<float>(scalar[0] - face_scalar);
        t.swapped = !cell.inner_behind;
        return t;
    }
    const glm::dvec2 farther = c.fourth - c.third;
    const Crossing crossing = crossing_of(c);
    // Coordinate 1 is 1 at the first point and 0 on the farther edge; 2 is 1 at the third and 0 on the nearer edge.
    t.k1_exact = -across(farther) / cross(c.third, farther);
    t.k2_exact = across(c.second) / cross(c.third, c.second);
    t.opposite1 = -(1 - crossing.along_first) / crossing.along_first;
    t.opposite2 = -(1 - crossing.along_second) / crossing.along_second;
    t.k1 = glm::vec2(t.k1_exact);
    t.k2 = glm::vec2(t.k2_exact);
    t.k3 = glm::vec2(1 / t.opposite1, 1 / t.opposite2);
    const auto linear = [&](const std::array<double, 4>& value, float& base, float& rise, glm::vec2& slope) {
        const double near = mix(value[0], value[1], crossing.along_first);
        const double far = mix(value[2], value[3], crossing.along_second);
        base = static_cast<float>(value[0]);
        rise = static_cast<float>(far - near);
        slope = glm::vec2((value[0] - near) * t.k1_exact + (value[2] - far) * t.k2_exact);
    };
    linear(depth, t.depth_base, t.depth_rise, t.depth_slope);
    linear(scalar, t.scalar_base, t.scalar_rise, t.scalar_slope);
    return t;
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
