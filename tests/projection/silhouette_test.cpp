#include "projection/silhouette.h"

#include "projection/thickness.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace visorder {
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
    }
    cell.inner_behind = behind;
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
        if (s.kind == SilhouetteClass::triangle) {
            EXPECT_EQ(std::abs(doubled_area(p(1), p(2), p(3))), hull);
            EXPECT_EQ(std::abs(doubled_area(p(0), p(1), p(2))) + std::abs(doubled_area(p(0), p(2), p(3))) +
                          std::abs(doubled_area(p(0), p(3), p(1))),
                      hull);
        }
        if (s.kind == SilhouetteClass::quad) {
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

        const glm::vec2 r(place - glm::dvec2(cell.at[0].x, cell.at[0].y));
        const bool quad = t.kind == SilhouetteClass::quad;
        const float t1 = glm::dot(t.k1, r) + (quad ? 1.0F : 0.0F);
        const float t2 = glm::dot(t.k2, r);
        const float t3 = quad ? t.k3.x * t1 : glm::dot(t.k3, r);
        const float g = quad ? std::max(t2, t.k3.y * t2) : 0.0F;
        const float m = quad ? std::max(t1, t3) : std::max({t1, t2, t3});
        const float one = t.depth.base + glm::dot(t.depth.slope, r) + t.depth.rise * g;
        const float other = one + t.depth.rise * (1 - g - m);
        const auto [front, back] = interval(seen, place);
        EXPECT_NEAR(t.swapped ? other : one, front, 2e-4);
        EXPECT_NEAR(t.swapped ? one : other, back, 2e-4);
        const float one_scalar = t.scalar.base + glm::dot(t.scalar.slope, r) + t.scalar.rise * g;
        EXPECT_NEAR(one_scalar, 3 * one + place.x, 1e-3);
    }
}

} // namespace
} // namespace visorder
