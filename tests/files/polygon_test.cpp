#include "files/polygon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <numbers>
#include <numeric>

using namespace visorder;
using namespace visorder::detail;
using testing::ElementsAre;
using testing::SizeIs;

namespace {

using Triangle = std::array<PointId, 3>;

std::vector<Triangle> split(const std::vector<glm::dvec3>& points)
{
    std::vector<PointId> polygon(points.size());
    std::iota(polygon.begin(), polygon.end(), 0u);
    return triangles_of(polygon, points);
}

glm::dvec3 doubled_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    return glm::cross(b - a, c - a);
}

/// Expects triangles all of the polygon's orientation, whose areas add up to its own: they cover it once.
void expect_cover(const std::vector<glm::dvec3>& points)
{
    const std::vector<Triangle> triangles = split(points);
    ASSERT_THAT(triangles, SizeIs(points.size() - 2));
    glm::dvec3 whole(0);
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        whole += doubled_area(points[0], points[i], points[i + 1]);
    double sum = 0;
    for (const auto& [a, b, c] : triangles) {
        const glm::dvec3 part = doubled_area(points[a], points[b], points[c]);
        EXPECT_GE(glm::dot(part, whole), 0);
        sum += glm::length(part);
    }
    EXPECT_DOUBLE_EQ(sum, glm::length(whole));
}

std::vector<glm::dvec3> turned(std::vector<glm::dvec3> points, int by)
{
    std::rotate(points.begin(), points.begin() + by, points.end());
    return points;
}

} // namespace

TEST(Polygon, MakesAFanOfAConvexOne)
{
    EXPECT_THAT(split({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
    EXPECT_THAT(split({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {-1, 1, 0}}),
                ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
}

TEST(Polygon, CoversAConcaveOneOnceFromAnyFirstCorner)
{
    const std::vector<glm::dvec3> arrow{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
    const std::vector<glm::dvec3> comb{{0, 0, 1}, {6, 0, 1}, {6, 4, 1}, {5, 1, 1}, {4, 4, 1},
                                       {3, 1, 1}, {2, 4, 1}, {1, 1, 1}, {0, 4, 1}};
    for (const auto& points : {arrow, comb})
        for (int first = 0; first < static_cast<int>(points.size()); ++first) {
            SCOPED_TRACE(first);
            std::vector<glm::dvec3> other = turned(points, first);
            expect_cover(other);
            for (glm::dvec3& p : other)
                p = {p.z, p.x, p.y};
            expect_cover(other);
            std::reverse(other.begin(), other.end());
            expect_cover(other);
        }
}

TEST(Polygon, SplitsOneWithoutAreaAllTheSame)
{
    EXPECT_THAT(split({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}), SizeIs(3));
    EXPECT_THAT(split({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), SizeIs(2));
}

TEST(Polygon, SplitsOneThatCrossesItself)
{
    EXPECT_THAT(split({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), SizeIs(2));
}

TEST(Polygon, TakesPolygonsOfManyCorners)
{
    constexpr int corners = 100'000;
    std::vector<glm::dvec3> circle, comb;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        circle.emplace_back(std::cos(angle), std::sin(angle), 0);
        comb.emplace_back(i, i % 2 == 0 ? 0 : 1, 0); // teeth, every second corner of which points inward
    }
    comb.emplace_back(corners, 2, 0);
    comb.emplace_back(-1, 2, 0);
    for (const auto& points : {circle, comb, std::vector<glm::dvec3>(corners, glm::dvec3(1, 2, 3))})
        EXPECT_THAT(split(points), SizeIs(points.size() - 2));
}
