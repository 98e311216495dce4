#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "scenes/generated_scene.h"
#include "scenes/unused_points.h"
#include "visorder/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace visorder::tests {

using namespace detail;

using namespace scenes;

namespace {

// Of the boundary: 2 a body less 2 a hole right through it.
long euler_characteristic(const Scene& scene)
{
    std::set<PointId> points;
    std::set<std::pair<PointId, PointId>> edges;
    for (const CellFace& face : scene.boundary().faces) {
        const FaceLoop loop = face_loop(scene.mesh(), face.cell, static_cast<int>(face.face));
        for (int i = 0; i < loop.count; ++i) {
            const PointId a = loop.begin()[i], b = loop.begin()[(i + 1) % loop.count];
            points.insert(a);
            edges.emplace(std::min(a, b), std::max(a, b));
        }
    }
    return static_cast<long>(points.size()) - static_cast<long>(edges.size()) +
           static_cast<long>(scene.boundary().faces.size());
}

double distance_from_axis(const glm::dvec3& point)
{
    return glm::length(glm::dvec2(point));
}

// The cells that have a point farther from the z axis than this.
Mesh cells_beyond(const Mesh& mesh, double radius)
{
    Mesh beyond;
    beyond.points = mesh.points;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
        if (std::ranges::any_of(mesh.cell(cell),
                                [&](PointId p) { return distance_from_axis(mesh.points[p]) > radius; }))
            beyond.add(mesh.shapes[cell], mesh.cell(cell));
    drop_unused_points(beyond);
    return beyond;
}

} // namespace

TEST(GearScene, IsARingWithSixteenTeeth)
{
    for (const std::string name : {"gear", "gear-helical"})
        for (const char* const size : {":900", ":3000", ":30000"}) {
            SCOPED_TRACE(name + size);
            const Mesh mesh = generate(name + size);
            const Scene scene(mesh);
            EXPECT_EQ(scene.boundary().component_count, 1u);
            EXPECT_EQ(euler_characteristic(scene), 0);
            EXPECT_EQ(Scene(cells_beyond(mesh, 2.5 + 1e-9)).boundary().component_count, 16u);
            for (const glm::dvec3& point : mesh.points) {
                EXPECT_GT(distance_from_axis(point), 1 - 1e-12);
                EXPECT_LT(distance_from_axis(point), 3.25 + 1e-12);
            }
        }
}

TEST(GearScene, WindsTheHelicalOnesTeethByHalfAPitch)
{
    const Mesh straight = generate("gear:3000");
    const Mesh helical = generate("gear-helical:3000");
    ASSERT_EQ(straight.points.size(), helical.points.size());
    const double pitch = 2 * std::acos(-1) / 16;
    for (std::size_t i = 0; i < straight.points.size(); ++i) {
        const glm::dvec3& p = straight.points[i];
        const double angle = p.z / 1.5 * pitch / 2;
        const glm::dvec3 wound(p.x * std::cos(angle) - p.y * std::sin(angle),
                               p.x * std::sin(angle) + p.y * std::cos(angle), p.z);
        EXPECT_LT(glm::distance(wound, helical.points[i]), 1e-12);
    }
    EXPECT_EQ(straight.vertices, helical.vertices);
}

TEST(ReactorScene, HasASquareArrayOfChannelsRightThrough)
{
    for (const auto& [specification, channels] :
         {std::pair<const char*, long>{"reactor:192", 1}, {"reactor:3000", 2}, {"reactor:30000", 5}}) {
        SCOPED_TRACE(specification);
        const Scene scene(generate(specification));
        EXPECT_EQ(scene.boundary().component_count, 1u);
        EXPECT_EQ(euler_characteristic(scene), 2 - 2 * channels * channels);
    }
}

TEST(ToriScene, HasTwoLinkedRings)
{
    for (const char* const specification : {"tori:96", "tori:3000"}) {
        SCOPED_TRACE(specification);
        const Mesh mesh = generate(specification);
        const Scene scene(mesh);
        EXPECT_EQ(scene.boundary().component_count, 2u);
        EXPECT_EQ(euler_characteristic(scene), 0);
        // The second passes through the plane of the first once inside of its hole and once outside of it.
        std::size_t inside = 0, outside = 0;
        for (std::size_t i = mesh.points.size() / 2; i < mesh.points.size(); ++i)
            if (std::abs(mesh.points[i].z) < 0.3) {
                const double distance = distance_from_axis(mesh.points[i]);
                EXPECT_TRUE(distance < 0.6 || distance > 1.6) << distance;
                ++(distance < 1 ? inside : outside);
            }
        EXPECT_GT(inside, 0u);
        EXPECT_GT(outside, 0u);
    }
}

} // namespace visorder::tests
