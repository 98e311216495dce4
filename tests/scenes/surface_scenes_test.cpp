#include "scene/boundary.h"
#include "scenes/generated_scene.h"
#include "visorder/checking.h"
#include "visorder/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>
#include <numeric>
#include <set>
#include <string>
#include <utility>

namespace visorder::tests {

using namespace detail;

using namespace scenes;

namespace {

const glm::dvec4 eyes[] = {{5, 3, 4, 1}, {0.3, -0.8, 0.5, 0}, {0, 0, 1, 0}};

// Of the order of the cells' numbers, which is wrong, so that all there is to find is looked for.
CheckResult checked(const Scene& scene, const glm::dvec4& eye)
{
    Order order;
    order.back_to_front.resize(scene.cell_count());
    std::iota(order.back_to_front.begin(), order.back_to_front.end(), CellId{0});
    return OrderChecker(scene).check(eye, order);
}

glm::dvec3 corner(const Mesh& mesh, CellId cell, std::size_t i)
{
    return mesh.points[mesh.cell(cell)[i]];
}

// Six times the volume that a closed surface encloses: positive where its triangles are counterclockwise from outside.
double enclosed(const Mesh& mesh)
{
    double sum = 0;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
        sum += glm::dot(corner(mesh, cell, 0), glm::cross(corner(mesh, cell, 1), corner(mesh, cell, 2)));
    return sum;
}

constexpr double sphere_volume = 4.18879; // of radius 1

} // namespace

TEST(SphereScene, IsAClosedUnitSphereSeenFromOutside)
{
    for (const char* const specification : {"sphere:20", "sphere:2000"}) {
        SCOPED_TRACE(specification);
        const Mesh mesh = generate(specification);
        for (const glm::dvec3& point : mesh.points)
            EXPECT_NEAR(glm::length(point), 1, 1e-15);
        for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
            EXPECT_GT(glm::dot(corner(mesh, cell, 0), glm::cross(corner(mesh, cell, 1), corner(mesh, cell, 2))), 0);
        EXPECT_EQ(mesh.points.size(), mesh.cell_count() / 2 + 2);
        EXPECT_TRUE(Scene(mesh).boundary().faces.empty());
    }
    EXPECT_NEAR(enclosed(generate("sphere:2000")) / 6, sphere_volume, 0.05);
}

TEST(ShellsScene, HasFiveClosedSpheresApart)
{
    for (const char* const specification : {"shells:300", "shells:500", "shells:3000"}) {
        SCOPED_TRACE(specification);
        const Mesh mesh = generate(specification);
        std::set<double> radii;
        for (const glm::dvec3& point : mesh.points) {
            const double radius = std::round(5 * glm::length(point)) / 5;
            EXPECT_NEAR(glm::length(point), radius, 1e-15);
            radii.insert(radius);
        }
        EXPECT_EQ(radii, (std::set<double>{0.2, 0.4, 0.6, 0.8, 1.0}));
        EXPECT_EQ(mesh.points.size(), mesh.cell_count() / 2 + 10);
        EXPECT_TRUE(Scene(mesh).boundary().faces.empty());
    }
}

TEST(ShellsScene, HasAnOrderFromEveryEye)
{
    for (const char* const specification : {"sphere:500", "shells:300", "shells:1000"}) {
        const Scene scene(generate(specification));
        for (const glm::dvec4& eye : eyes) {
            SCOPED_TRACE(specification);
            const CheckResult result = checked(scene, eye);
            EXPECT_GT(result.violations, 0u);
            EXPECT_TRUE(result.overlapping.empty());
            EXPECT_TRUE(result.order_exists());
        }
    }
}

TEST(KnotScene, IsAClosedTubeThatDoesNotPassThroughItself)
{
    for (const char* const specification : {"knot:300", "knot:2000"}) {
        SCOPED_TRACE(specification);
        const Scene scene(generate(specification));
        EXPECT_TRUE(scene.boundary().faces.empty());
        EXPECT_EQ(scene.mesh().points.size(), scene.cell_count() / 2); // a torus
        EXPECT_GT(enclosed(scene.mesh()), 0);
        for (const glm::dvec4& eye : eyes)
            EXPECT_TRUE(checked(scene, eye).overlapping.empty());
    }
}

TEST(CardsScene, HasRectanglesOfOneSize)
{
    const Mesh mesh = generate("cards:2000:3");
    ASSERT_EQ(mesh.cell_count(), 2000u);
    ASSERT_EQ(mesh.points.size(), 4000u);
    const double width = glm::distance(mesh.points[0], mesh.points[1]);
    for (std::size_t i = 0; i < mesh.points.size(); i += 4) {
        const glm::dvec3* const p = &mesh.points[i];
        EXPECT_NEAR(glm::distance(p[0], p[1]), width, 1e-14);
        EXPECT_NEAR(glm::distance(p[1], p[2]), 0.6 * width, 1e-14);
        EXPECT_NEAR(glm::dot(p[1] - p[0], p[2] - p[1]), 0, 1e-14);
        EXPECT_NEAR(glm::distance(p[0] + p[2], p[1] + p[3]), 0, 1e-14);
    }
}

TEST(CardsScene, HasAboutAsManyCrossingsAsCards)
{
    for (const std::string size : {"400", "4000"})
        for (const char* const seed : {":1", ":2"}) {
            const Scene scene(generate("cards:" + size + seed));
            std::set<std::pair<CellId, CellId>> crossing;
            for (const auto& [a, b] : checked(scene, eyes[0]).overlapping)
                crossing.emplace(a / 2, b / 2);
            const double cards = scene.cell_count() / 2;
            EXPECT_NEAR(static_cast<double>(crossing.size()), 0.85 * cards, 0.25 * cards) << size << seed;
        }
}

} // namespace visorder::tests
