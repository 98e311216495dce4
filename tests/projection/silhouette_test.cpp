#include "projection/silhouette.h"

#include "projection/split_linear.h"
#include "projection/thickness.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace visorder::tests {

using namespace detail;
namespace {

using Points = std::array<glm::ivec2, 4>;

long doubled_area(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c)
{
    return static_cast<long>(b.x - a.x) * (c.y - a.y) - static_cast<long>(b.y - a.y) * (c.x - a.x);
}

// Twice the area of the hull of four points: the four triangles cover it twice.
long doubled_hull_area(const Points& p)
{
    return (std::abs(doubled_area(p[0], p[1], p[2])) + std::abs(doubled_area(p[0], p[1], p[3])) +
            std::abs(doubled_area(p[0], p[2], p[3])) + std::abs(doubled_area(p[1], p[2], p[3]))) /
           2;
}

struct Seen {
    Points points;
    std::array<double, 4> depth;
    Silhouette silhouette;
    std::string reproduce;
};

// Few places, so that points coincide and lie in line often. Depths make a cell whose vertices stand in VTK's order.
std::vector<Seen> random_cells(int count, int range)
{
    std::mt19937 random(7);
    std::vector<Seen> cells;
    for (int i = 0; i < count; ++i) {
        Seen seen{};
        for (std::size_t k = 0; k < 4; ++k) {
            seen.points[k] = {static_cast<int>(random() % static_cast<unsigned>(range)),
                              static_cast<int>(random() % static_cast<unsigned>(range))};
            seen.depth[k] = static_cast<double>(random() % 1000) / 100;
        }
        const auto at = [&](std::size_t k) { return glm::dvec3(seen.points[k], -seen.depth[k]); };
        if (glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0)) < 0) {
            std::swap(seen.points[0], seen.points[1]);
            std::swap(seen.depth[0], seen.depth[1]);
        }
        seen.silhouette = silhouette_of({glm::dvec2(seen.points[0]), glm::dvec2(seen.points[1]),
                                         glm::dvec2(seen.points[2]), glm::dvec2(seen.points[3])});
        for (const glm::ivec2& p : seen.points)
            seen.reproduce += fmt::format("({}, {}) ", p.x, p.y);
        cells.push_back(seen);
    }
    return cells;
}

VisibleCell visible(const Seen& seen)
{
    VisibleCell cell{};
    cell.kind = seen.silhouette.kind;
    const bool behind = seen.silhouette.first_behind;
    const std::size_t rotated = cell.kind == SilhouetteClass::quad && behind ? 2 : 0;
    for (std::size_t i = 0; i < 4; ++i) {
        cell.points[i] = seen.silhouette.points[i ^ rotated];
        cell.at[i] = glm::dvec3(seen.points[cell.points[i]], seen.depth[cell.points[i]]);
        cell.areas[i] = seen.silhouette.areas[i ^ rotated];
    }
    cell.counterclockwise = seen.silhouette.counterclockwise == (rotated == 0);
    cell.inner_behind = behind;
    // Where points lie on one another's edges.
    cell.least_width = 1e-9;
    return cell;
}

CellValues values(const Seen& seen, const VisibleCell& cell)
{
    CellValues result{};
    for (std::size_t i = 0; i < 4; ++i) {
        result.depth[i] = seen.depth[cell.points[i]];
        result.scalar[i] = 3 * result.depth[i] + cell.at[i].x;
    }
    return result;
}

// Where the line through a place enters and leaves the cell, from the planes of the faces that cover the place.
std::pair<double, double> interval(const Seen& seen, const glm::dvec2& place)
{
    std::pair<double, double> result{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t out = 0; out < 4; ++out) {
        const std::size_t i = (out + 1) % 4;
        const std::size_t j = (out + 2) % 4;
        const std::size_t k = (out + 3) % 4;
        const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
        const glm::dvec2 a(seen.points[i]);
        const glm::dvec2 b(seen.points[j]);
        const glm::dvec2 c(seen.points[k]);
        const double whole = cross(b - a, c - a);
        if (whole == 0)
            continue;
        const double first = cross(b - place, c - place) / whole;
        const double second = cross(c - place, a - place) / whole;
        const double third = 1 - first - second;
        if (std::min({first, second, third}) < -1e-12)
            continue;
        const double depth = first * seen.depth[i] + second * seen.depth[j] + third * seen.depth[k];
        result.first = std::min(result.first, depth);
        result.second = std::max(result.second, depth);
    }
    return result;
}

TEST(Silhouette, TrianglesCoverTheHullOnce)
{
    std::array<int, 3> found{};
    for (const Seen& seen : random_cells(20000, 5)) {
        SCOPED_TRACE(seen.reproduce);
        const auto& s = seen.silhouette;
        const auto p = [&](std::size_t i) { return seen.points[s.points[i]]; };
        ++found[static_cast<std::size_t>(s.kind)];
        const long hull = doubled_hull_area(seen.points);
        EXPECT_EQ(s.kind == SilhouetteClass::empty, hull == 0);
        for (std::size_t i = 0; i < 4 && s.kind != SilhouetteClass::empty; ++i)
            EXPECT_EQ(s.areas[i], std::abs(doubled_area(p((i + 1) % 4), p((i + 2) % 4), p((i + 3) % 4)))) << i;
        if (s.kind == SilhouetteClass::triangle) {
            EXPECT_EQ(std::abs(doubled_area(p(1), p(2), p(3))), hull);
            EXPECT_EQ(s.counterclockwise, doubled_area(p(1), p(2), p(3)) > 0);
            EXPECT_EQ(std::abs(doubled_area(p(0), p(1), p(2))) + std::abs(doubled_area(p(0), p(2), p(3))) +
                          std::abs(doubled_area(p(0), p(3), p(1))),
                      hull);
        }
        if (s.kind == SilhouetteClass::quad) {
            EXPECT_EQ(s.counterclockwise, doubled_area(p(0), p(2), p(1)) > 0);
            EXPECT_EQ(std::abs(doubled_area(p(0), p(1), p(2))) + std::abs(doubled_area(p(0), p(1), p(3))), hull);
            EXPECT_LT(doubled_area(p(0), p(1), p(2)) * doubled_area(p(0), p(1), p(3)), 0);
            EXPECT_LT(doubled_area(p(2), p(3), p(0)) * doubled_area(p(2), p(3), p(1)), 0);
        }
    }
    for (const int count : found)
        EXPECT_GT(count, 100);
}

TEST(Thickness, IsLargestAtTheThickestPointAndRightThere)
{
    for (const Seen& seen : random_cells(5000, 9)) {
        SCOPED_TRACE(seen.reproduce);
        if (seen.silhouette.kind == SilhouetteClass::empty)
            continue;
        const VisibleCell cell = visible(seen);
        const ThickPoint point = thick_point(cell, values(seen, cell));
        const auto [front, back] = interval(seen, point.at);
        EXPECT_NEAR(point.front_depth, front, 1e-9);
        EXPECT_NEAR(point.back_depth, back, 1e-9);
    }
}

TEST(Thickness, GivesEntryAndExitAtEveryPixel)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0, 1);
    for (const Seen& seen : random_cells(5000, 9)) {
        SCOPED_TRACE(seen.reproduce);
        if (seen.silhouette.kind == SilhouetteClass::empty)
            continue;
        const VisibleCell cell = visible(seen);
        const Thickness t = thickness_of(cell, values(seen, cell));
        std::array<double, 4> shares{share(random), share(random), share(random), share(random)};
        const double sum = shares[0] + shares[1] + shares[2] + shares[3];
        glm::dvec2 place(0);
        for (std::size_t i = 0; i < 4; ++i)
            place += shares[i] / sum * glm::dvec2(seen.points[i]);

        // As the fragment shader has it.
        const glm::dvec2 r = place - glm::dvec2(cell.at[0].x, cell.at[0].y);
        const double t1 = t.first1 + glm::dot(t.slope1, r);
        const double t2 = glm::dot(t.slope2, r);
        const glm::dvec4 shape(t.shape());
        const double g = t2 * (t2 > 0 ? 1 - shape.w : shape.z);
        const double m = std::max({t1, shape.x * t1 + shape.y * t2, shape.w * t2});
        const auto of = [&](const Thickness::Linear& l) { return l.base + l.along1 * t1 + l.along2 * t2 + l.rise * g; };
        const double one = of(t.depth);
        const double other = one + t.depth.rise * (1 - g - m);
        EXPECT_NEAR(t.at(r), 1 - g - m, 1e-5 * (1 + std::abs(t1) + std::abs(t2)));
        const auto [front, back] = interval(seen, place);
        EXPECT_NEAR(t.swapped ? other : one, front, 1e-4);
        EXPECT_NEAR(t.swapped ? one : other, back, 1e-4);
        EXPECT_NEAR(of(t.scalar), 3 * one + place.x, 1e-4);
    }
}

TEST(Thickness, InterpolatesBetweenThePointsAndTheThickestPoint)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<float> number(0, 1);
    for (const Seen& seen : random_cells(5000, 9)) {
        SCOPED_TRACE(seen.reproduce);
        if (seen.silhouette.kind == SilhouetteClass::empty)
            continue;
        const VisibleCell cell = visible(seen);
        if (std::min({cell.areas[0], cell.areas[1], cell.areas[2], cell.areas[3]}) == 0)
            continue;
        const CellValues of_cell = values(seen, cell);
        const Thickness t = thickness_of(cell, of_cell);
        std::array<glm::vec4, 4> at_points{};
        for (glm::vec4& value : at_points)
            value = {number(random), number(random), number(random), number(random)};
        const std::array<glm::vec4, 5> colours = t.interpolate(at_points);
        const auto at = [&](const glm::dvec3& p) {
            const glm::dvec2 r(p.x - cell.at[0].x, p.y - cell.at[0].y);
            const auto t1 = static_cast<float>(t.first1 + glm::dot(t.slope1, r));
            const auto t2 = static_cast<float>(glm::dot(t.slope2, r));
            const glm::vec4 shape = t.shape();
            const float g = t2 * (t2 > 0 ? 1 - shape.w : shape.z);
            const float m = std::max({t1, shape.x * t1 + shape.y * t2, shape.w * t2});
            return colours[0] + colours[1] * t1 + colours[2] * t2 + colours[3] * g + colours[4] * m;
        };
        const ThickPoint thick = thick_point(cell, of_cell);
        glm::vec4 expected(0);
        for (std::size_t i = 0; i < 4; ++i)
            expected += static_cast<float>(0.5 * (thick.front_shares[i] + thick.back_shares[i])) * at_points[i];
        EXPECT_LT(glm::length(at(glm::dvec3(thick.at, 0)) - expected), 2e-4F);
        for (std::size_t i = seen.silhouette.kind == SilhouetteClass::triangle ? 1 : 0; i < 4; ++i)
            EXPECT_LT(glm::length(at(cell.at[i]) - at_points[i]), 2e-4F) << "point " << i;
    }
}

// In single precision, as shaders compute it, of functions so steep that all digits cancel.
TEST(SplitLinear, IsRightWhereTermsCancel)
{
    std::mt19937 random(9);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int i = 0; i < 20000; ++i) {
        const double steep = std::pow(10.0, 4 * number(random));
        const double angle = 4 * number(random);
        const glm::dvec2 slope = steep * glm::dvec2(std::cos(angle), std::sin(angle));
        const int reach = 1 << (i % 11);
        const glm::vec2 p(std::round(reach * number(random)), std::round(reach * number(random)));
        // Zero near that pixel.
        const double offset = number(random) - glm::dot(slope, glm::dvec2(p));
        const SplitLinear split = split_linear(slope, offset, reach);
        volatile float high = split.high.x * p.x;
        high = high + split.high.y * p.y;
        high = high + split.high_offset;
        volatile float low = split.low.x * p.x;
        low = low + split.low.y * p.y;
        low = low + split.low_offset;
        const double expected = glm::dot(slope, glm::dvec2(p)) + offset;
        const double bound = 8 * 0x1p-47 * (reach + 2.0) * (reach + 2.0) * steep + 0x1p-23 * std::abs(expected);
        EXPECT_NEAR(high + low, expected, bound)
            << "slope " << slope.x << ", " << slope.y << " at " << p.x << ", " << p.y;
    }
}

} // namespace
} // namespace visorder::tests
