#include "scenes/generated_scene.h"

#include "tests/scenes/face_relations.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace visorder::tests {

using namespace scenes;

namespace {

constexpr CellId none = 0xffffffff;

TEST(ContactScene, TouchesInAPlaneWithoutCommonPoints)
{
    Mesh mesh = generate("contact:5000");
    std::size_t in_plane = 0;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        double low = 2;
        double high = 0;
        for (const PointId vertex : mesh.cell(cell)) {
            low = std::min(low, mesh.points[vertex].x);
            high = std::max(high, mesh.points[vertex].x);
        }
        EXPECT_TRUE(high <= 1 || low >= 1) << "cell " << cell;
    }
    for (const glm::dvec3& point : mesh.points)
        in_plane += point.x == 1;
    EXPECT_GT(in_plane, 100u);
    EXPECT_EQ(weld(mesh), 0u);
}

TEST(CavityScene, HasAnIslandInsideAShellAndAGapBetween)
{
    const Mesh mesh = generate("cavity:5000");
    std::size_t island = 0;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        std::size_t near = 0;
        for (const PointId vertex : mesh.cell(cell)) {
            const double distance = glm::distance(mesh.points[vertex], glm::dvec3(0.5));
            EXPECT_TRUE(distance < 0.2 || distance > 0.3);
            near += distance < 0.2;
        }
        EXPECT_TRUE(near == 0 || near == 4) << "cell " << cell << " spans the gap";
        island += near == 4;
    }
    EXPECT_GT(island, 20u);
    EXPECT_GT(mesh.cell_count() - island, 20u);
}

TEST(OffsetScene, StandsFarFromTheOrigin)
{
    for (const glm::dvec3& point : generate("offset:2000").points) {
        EXPECT_NEAR(point.x, 1e7 + 0.5, 0.5);
        EXPECT_NEAR(point.y, -2e7 + 0.5, 0.5);
        EXPECT_NEAR(point.z, 3e7 + 0.5, 0.5);
    }
}

TEST(GridScene, HasCoordinatesAtEqualStepsExactly)
{
    const Mesh mesh = generate("grid:6000");
    std::array<std::vector<double>, 3> places;
    for (const glm::dvec3& point : mesh.points)
        for (int axis = 0; axis < 3; ++axis)
            places[static_cast<std::size_t>(axis)].push_back(point[axis]);
    for (std::vector<double>& axis : places) {
        std::sort(axis.begin(), axis.end());
        axis.erase(std::unique(axis.begin(), axis.end()), axis.end());
        ASSERT_EQ(axis.size(), 11u);
        for (std::size_t i = 0; i < axis.size(); ++i)
            EXPECT_EQ(axis[i], static_cast<double>(i) * axis[1]);
    }
}

// Which ring, if any, obstructs itself all the way around: the number of its first cell.
CellId whole_ring_in_a_cycle(const Mesh& mesh, const Relations& behind)
{
    const CellId ring = static_cast<CellId>(mesh.cell_count() / 3);
    for (CellId first = 0; first < mesh.cell_count(); first += ring)
        for (const CellId step : {CellId{1}, ring - 1}) {
            bool all = true;
            for (CellId i = 0; i < ring; ++i)
                all = all && behind[first + i] == std::vector<CellId>{first + (i + step) % ring};
            if (all)
                return first;
        }
    return none;
}

TEST(PinwheelScene, HasACycleOfAWholeRingFromEveryDirection)
{
    for (const char* const specification : {"pinwheel:48", "pinwheel", "pinwheel:600"}) {
        const Mesh mesh = generate(specification);
        std::mt19937_64 random(3);
        for (int i = 0; i < 200; ++i) {
            glm::dvec3 direction = random_direction(random);
            if (i < 8) // the directions farthest from all the rings' axes
                direction = {i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1};
            SCOPED_TRACE(testing::Message()
                         << specification << " along " << direction.x << " " << direction.y << " " << direction.z);
            for (const glm::dvec4& eye : {glm::dvec4(direction, 0), glm::dvec4(1e5 * direction, 1)})
                EXPECT_NE(whole_ring_in_a_cycle(mesh, relations_across_faces(mesh, eye)), none);
        }
    }
}

TEST(PinwheelScene, HasCellsThatDoNotOverlap)
{
    // Two tetrahedra have no common interior if the plane of a face of one, or one along an edge of each, divides them.
    // Their volumes are far from zero here, so what doubles decide wrongly is touching only, which the slack forgives.
    for (const char* const specification : {"pinwheel:48", "pinwheel:192"}) {
        const Mesh mesh = generate(specification);
        const auto corner = [&](CellId cell, std::size_t i) { return mesh.points[mesh.cell(cell)[i]]; };
        const auto divided_along = [&](CellId a, CellId b, const glm::dvec3& normal) {
            double a_low = 1e300, a_high = -1e300, b_low = 1e300, b_high = -1e300;
            for (std::size_t i = 0; i < 4; ++i) {
                a_low = std::min(a_low, glm::dot(normal, corner(a, i)));
                a_high = std::max(a_high, glm::dot(normal, corner(a, i)));
                b_low = std::min(b_low, glm::dot(normal, corner(b, i)));
                b_high = std::max(b_high, glm::dot(normal, corner(b, i)));
            }
            const double slack = 1e-11 * glm::length(normal);
            return glm::length(normal) > 1e-9 && (a_high <= b_low + slack || b_high <= a_low + slack);
        };
        const auto edges = [&](CellId cell) {
            std::vector<glm::dvec3> result;
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = 0; j < i; ++j)
                    result.push_back(corner(cell, i) - corner(cell, j));
            return result;
        };
        for (CellId a = 0; a < mesh.cell_count(); ++a)
            for (CellId b = 0; b < a; ++b) {
                bool divided = false;
                for (const CellId cell : {a, b})
                    for (const glm::dvec3& first : edges(cell))
                        for (const glm::dvec3& second : edges(cell))
                            divided = divided || divided_along(a, b, glm::cross(first, second));
                for (const glm::dvec3& first : edges(a))
                    for (const glm::dvec3& second : edges(b))
                        divided = divided || divided_along(a, b, glm::cross(first, second));
                EXPECT_TRUE(divided) << specification << ": cells " << a << " and " << b;
            }
    }
}

} // namespace

} // namespace visorder::tests
