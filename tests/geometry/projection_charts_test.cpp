#include "geometry/projection_charts.h"

#include "geometry/exact_predicates.h"
#include "geometry/face_overlap.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "tests/checking/expectations.h"
#include "tests/checking/small_scenes.h"
#include "visorder/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

struct Triangles {
    Mesh mesh;
    Box bounds;

    explicit Triangles(Mesh of) : mesh(std::move(of))
    {
        for (const glm::dvec3& p : mesh.points)
            bounds.add(p);
    }
};

// Every face that covers another has a chart in which their boxes meet and the covered one is not all nearer. Returns
// how many there are.
std::size_t expect_that_boxes_meet(const Triangles& of, const glm::dvec4& eye)
{
    const ProjectionCharts charts(of.bounds, eye);
    EXPECT_GE(charts.count(), 1);
    EXPECT_LE(charts.count(), eye.w == 0 ? 1 : 6);
    std::vector<SeenFace> faces;
    std::vector<std::vector<std::optional<Box>>> boxes;
    for (CellId cell = 0; cell < of.mesh.cell_count(); ++cell) {
        std::vector<glm::dvec3> points;
        for (PointId v : of.mesh.cell(cell))
            points.push_back(of.mesh.points[v]);
        faces.push_back(seen_face(points, eye));
        auto& of_face = boxes.emplace_back();
        for (int chart = 0; chart < charts.count(); ++chart)
            of_face.push_back(charts.box(faces.back().vertices(), chart));
    }
    std::size_t pairs = 0;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t g = 0; g < faces.size(); ++g) {
            if (f == g || faces[f].turn == Sign::zero || faces[g].turn == Sign::zero)
                continue;
            bool meet = false;
            for (std::size_t chart = 0; chart < boxes[f].size() && !meet; ++chart)
                if (const auto& a = boxes[f][chart], &b = boxes[g][chart]; a && b)
                    meet = a->min.x <= b->max.x && b->min.x <= a->max.x && a->min.y <= b->max.y &&
                           b->min.y <= a->max.y && a->min.z <= b->max.z;
            const Overlap overlap = face_overlap(faces[f], faces[g], eye);
            const bool covers =
                overlap == Overlap::nearer || overlap == Overlap::coincident || overlap == Overlap::crossing;
            EXPECT_TRUE(meet || !covers) << "triangles " << f << " and " << g;
            pairs += covers;
        }
    return pairs;
}

TEST(ProjectionCharts, FacesThatOverlapMeetInSomeChart)
{
    std::size_t pairs = 0;
    for (std::uint64_t seed = 1; seed <= 60 && !HasFailure(); ++seed) {
        const Triangles of(random_triangles(24, seed % 2 == 0 ? 6 : 60, seed));
        Random random(seed);
        std::vector<glm::dvec4> eyes = small_scene_eyes(Scene(of.mesh), seed);
        const glm::dvec3 size = of.bounds.max - of.bounds.min;
        for (int i = 0; i < 12; ++i) {
            // In the bounds, beside them, and far away; also where the position has to be rounded.
            const double away = i % 3 == 0 ? 1 : i % 3 == 1 ? 4 : 1e6;
            const double x = random.real() - 0.5, y = random.real() - 0.5, z = random.real() - 0.5;
            const double weight = i % 2 == 0 ? 1 : i % 4 == 1 ? 0.3 : -7;
            eyes.emplace_back((of.bounds.middle() + away * glm::dvec3(x, y, z) * size) * weight, weight);
            eyes.emplace_back(x, y, z, 0);
        }
        for (const glm::dvec4& eye : eyes) {
            SCOPED_TRACE(reproduce("random triangles " + std::to_string(seed), eye));
            pairs += expect_that_boxes_meet(of, eye);
        }
    }
    EXPECT_GT(pairs, 10000u);
}

// Where one plane shows all: points on one ray from the eye have images within twice the error of each other, and the
// farther one is the one with the greater depth.
TEST(ProjectionCharts, ImagesOfPointsOnOneRayAreTheSame)
{
    Random random(11);
    std::size_t planes = 0;
    for (int i = 0; i < 4000; ++i) {
        const double extent = i % 3 == 0 ? 1 : i % 3 == 1 ? 1e-7 : 1e9;
        const auto point = [&] {
            const double x = random.real() - 0.5, y = random.real() - 0.5, z = random.real() - 0.5;
            return glm::dvec3(x, y, z) * extent;
        };
        const Box bounds{glm::dvec3(-0.5 * extent), glm::dvec3(0.5 * extent)};
        const bool parallel = i % 2 == 0;
        const glm::dvec4 eye(point() * (parallel ? 1.0 : 1 + 8 * random.real()), parallel ? 0 : 1);
        const ProjectionCharts charts(bounds, eye);
        EXPECT_TRUE(charts.has_images() || !parallel);
        if (!charts.has_images())
            continue;
        ++planes;
        EXPECT_EQ(charts.count(), 1);
        const glm::dvec3 far = point();
        // Halves and quarters of these coordinates are exact enough: what rounds them is far below the error.
        const glm::dvec3 near =
            parallel ? far + glm::dvec3(eye) * 0.25 : far + (glm::dvec3(eye) - far) * (random.real() * 0.25);
        if (std::max({std::abs(near.x), std::abs(near.y), std::abs(near.z)}) > 0.5 * extent)
            continue;
        SCOPED_TRACE(reproduce("two points on a ray", eye));
        const glm::dvec3 f = charts.image(far), n = charts.image(near), error = charts.image_error();
        EXPECT_LE(std::abs(f.x - n.x), 2 * error.x);
        EXPECT_LE(std::abs(f.y - n.y), 2 * error.y);
        EXPECT_LE(n.z, f.z + 2 * error.z);
        EXPECT_GT(error.x, 0);
        // And the error is small beside the scene.
        EXPECT_LT(error.x, parallel ? 1e-13 * extent : 1e-10);
    }
    EXPECT_GT(planes, 2500u);
}

TEST(ProjectionCharts, ShowFewSidesOfTheCubeFromAfar)
{
    const Box bounds{glm::dvec3(0), glm::dvec3(8)};
    EXPECT_EQ(ProjectionCharts(bounds, {4, 4, 4, 1}).count(), 6);
    EXPECT_EQ(ProjectionCharts(bounds, {4, 4, 400, 1}).count(), 1);
    EXPECT_EQ(ProjectionCharts(bounds, {4, 4, 400, 0}).count(), 1);
    // Also in no direction of an axis.
    EXPECT_EQ(ProjectionCharts(bounds, {104, 4, 104, 1}).count(), 1);
    EXPECT_EQ(ProjectionCharts(bounds, {104, 104, 104, 1}).count(), 1);
    // Close to the scene; on the border between two sides.
    EXPECT_FALSE(ProjectionCharts(bounds, {8.25, 4, 8.25, 1}).has_images());
    EXPECT_GE(ProjectionCharts(bounds, {8.25, 4, 8.25, 1}).count(), 2);
    EXPECT_LT(ProjectionCharts(bounds, {8.25, 4, 8.25, 1}).count(), 6);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Triangles of(random_triangles(30, 8, seed));
        for (const glm::dvec4& eye :
             {glm::dvec4(4, 4, 400, 1), glm::dvec4(104, 4, 104, 1), glm::dvec4(104, 104, 104, 1),
              glm::dvec4(8, 8, 8, 1), glm::dvec4(4, 0, 0, 1), glm::dvec4(-8, -8, 0, 1), glm::dvec4(16, 4, 12, 1)}) {
            SCOPED_TRACE(reproduce("random triangles " + std::to_string(seed), eye));
            expect_that_boxes_meet(of, eye);
        }
    }
}

TEST(ProjectionCharts, FacesThatOverlapMeetAtAnyPlaceAndOfAnySize)
{
    for (const double scale : {1e-300, 1e-200, 0.1, 1e200, 1e305})
        for (const double shift : {0.0, 1e9}) {
            Mesh mesh = random_triangles(30, 30, 5);
            for (glm::dvec3& p : mesh.points)
                p = (p + shift) * (scale > 1e300 ? scale / (1 + shift) : scale);
            const Triangles of(mesh);
            const glm::dvec3 middle = of.bounds.middle(), size = of.bounds.max - of.bounds.min;
            for (const double away : {0.0, 0.3, 1.0, 50.0}) {
                const glm::dvec3 at = middle + away * glm::dvec3(0.5, -0.2, 0.7) * size;
                SCOPED_TRACE(reproduce("triangles times " + std::to_string(scale), glm::dvec4(at, 1)));
                expect_that_boxes_meet(of, glm::dvec4(at, 1));
            }
            expect_that_boxes_meet(of, {1, 2, -3, 0});
        }
}

} // namespace
} // namespace visorder::tests
