#include "scene/orientations.h"
#include "tests/checking/brute_force.h"
#include "tests/checking/expectations.h"
#include "tests/checking/small_scenes.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"
#include "visorder/sorters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

// Cells that overlap by a rounding error, lie flat, or have coordinates at the end of the range of doubles, held
// against the definition of "occludes" by all pairs of cells.

namespace visorder::tests {

using namespace detail;
namespace {

class HardCells : public testing::TestWithParam<const char*> {
protected:
    // Of all pairs of solid cells that do not overlap, outside of true cycles. The eye is seen with a weight of 1 or 0
    // here, and by the sorter with `weight` times that.
    static void expect_right(const Scene& scene, const std::string& name, const std::vector<glm::dvec4>& eyes,
                             double weight = 1)
    {
        const auto sorter = make_sorter(GetParam(), scene);
        const auto& overlapping = scene.overlapping_cells();
        if (overlapping.empty()) {
            EXPECT_EQ(sorter->guarantee(), Guarantee::exact) << name;
        } else {
            EXPECT_NE(sorter->guarantee(), Guarantee::exact) << name;
            if (sorter->guarantee() == Guarantee::approximate)
                return;
        }
        const CellId n = scene.cell_count();
        const auto caller = scene.caller_cells();
        for (const glm::dvec4& eye : eyes) {
            SCOPED_TRACE(reproduce(name, eye * weight));
            std::vector<std::vector<bool>> occludes(n, std::vector<bool>(n));
            for (CellId a = 0; a < n; ++a)
                for (CellId b = 0; b < n; ++b)
                    occludes[a][b] = a != b && scene.orientations().sign[a] != 0 && scene.orientations().sign[b] != 0 &&
                                     !std::binary_search(overlapping.begin(), overlapping.end(),
                                                         std::pair<CellId, CellId>(std::minmax(a, b))) &&
                                     brute_force::obstructs<brute_force::Number>(scene, a, b, eye);
            std::vector<std::vector<bool>> before = occludes;
            for (CellId k = 0; k < n; ++k)
                for (CellId a = 0; a < n; ++a)
                    for (CellId b = 0; b < n; ++b)
                        before[a][b] = before[a][b] || (before[a][k] && before[k][b]);
            const Order order = sorted(*sorter, eye * weight);
            std::vector<std::size_t> place(n);
            for (std::size_t i = 0; i < n; ++i)
                place[order.back_to_front[i]] = i;
            for (CellId a = 0; a < n; ++a)
                for (CellId b = 0; b < n; ++b)
                    EXPECT_FALSE(occludes[a][b] && !before[b][a] && place[caller[a]] < place[caller[b]])
                        << "cell " << caller[a] << " occludes " << caller[b];
            if (HasFailure())
                return;
        }
    }

    // Directions and positions around a scene, at a corner and in the middle.
    static std::vector<glm::dvec4> eyes_around(const Scene& scene)
    {
        const glm::dvec3 middle = scene.bounds().middle(), size = scene.bounds().max - scene.bounds().min;
        std::vector<glm::dvec4> eyes{
            {0, 0, 1, 0}, {1, -1, 1, 0}, {1, 2, -3, 0}, glm::dvec4(middle, 1), glm::dvec4(scene.bounds().max, 1)};
        for (const glm::dvec3& d : {glm::dvec3(2, 1, 1), glm::dvec3(-1, 3, 1), glm::dvec3(0, 0, -2)})
            eyes.emplace_back(middle + size * d, 1);
        return eyes;
    }
};

// Boxes in a column, faces shared, but for two in the middle, which overlap by `gap` below zero.
Mesh column_with_overlap(double gap)
{
    Mesh mesh;
    for (int i = 0; i < 6; ++i) {
        const double low = i == 3 ? 3 + gap : i;
        add_box(mesh, {0, 0, low}, {1, 1, i + 1.0});
    }
    weld(mesh);
    return mesh;
}

TEST_P(HardCells, KeepRelationsThroughAPairThatOverlapsByARoundingError)
{
    for (const double gap : {0.0, 4e-16, -4.440892098500626e-16, -1e-9, -0.25}) {
        const Mesh mesh = column_with_overlap(gap);
        for (const bool whole : {true, false}) {
            const Scene scene(whole ? mesh : subdivide(mesh).mesh);
            expect_right(scene, fmt::format("column with a gap of {}, {}", gap, whole ? "whole" : "subdivided"),
                         whole ? eyes_around(scene) : std::vector<glm::dvec4>{{0, 0, 1, 0}, {0.5, 0.25, 9, 1}});
        }
    }
}

TEST_P(HardCells, PutAPairThatOverlapsALittleTheRightWayRound)
{
    const Scene scene(column_with_overlap(-1e-9));
    const auto sorter = make_sorter(GetParam(), scene);
    for (const double up : {1.0, -1.0}) {
        const Order order = sorted(*sorter, {0, 0, up, 0});
        std::vector<CellId> upwards(order.back_to_front);
        if (up < 0)
            std::reverse(upwards.begin(), upwards.end());
        if (sorter->guarantee() != Guarantee::approximate) {
            EXPECT_EQ(upwards, (std::vector<CellId>{0, 1, 2, 3, 4, 5}));
        }
    }
}

TEST_P(HardCells, KeepRelationsBesideBoxesMovedByAnUlp)
{
    for (std::uint64_t seed = 1; seed <= 12 && !HasFailure(); ++seed) {
        Random random(seed);
        const auto moved = [&](double x) {
            const int way = random.below(6);
            return way == 0 ? std::nextafter(x, 1e9) : way == 1 ? std::nextafter(x, -1e9) : x;
        };
        Mesh mesh;
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 low(moved(1 + i % 2), moved(1), moved(1 + i / 2));
            const glm::dvec3 high(moved(2 + i % 2), moved(2), moved(2 + i / 2));
            add_box(mesh, low, high);
        }
        if (seed % 2 == 0)
            weld(mesh);
        const Scene scene(mesh);
        expect_right(scene, fmt::format("boxes moved by an ulp {}", seed), eyes_around(scene));
    }
}

TEST_P(HardCells, KeepRelationsBesideAFlatCellAtTheBoundary)
{
    Mesh mesh;
    const double x = 1000000002.3, y = 1000000004.3;
    mesh.points = {{y, 0, 0}, {y, 0, 2}, {y, 2, 2}, {x, 2, 2}, {x, 2, 0}, {x, 0, 0}, {x, 0, 2}, {x, 2, 4}};
    for (const auto& cell :
         {std::array<PointId, 4>{0, 1, 2, 3}, {0, 4, 5, 3}, {1, 3, 6, 7}, {5, 6, 4, 3}, {2, 3, 6, 1}})
        mesh.add(CellShape::tetrahedron, cell);
    const Scene scene(mesh);
    EXPECT_EQ(scene.orientations().flat, 2u);
    expect_right(scene, "flat cell at the boundary", eyes_around(scene));
    std::vector<glm::dvec4> at_vertices;
    for (const glm::dvec3& p : mesh.points)
        at_vertices.emplace_back(p, 1);
    expect_right(scene, "flat cell at the boundary", at_vertices);
}

TEST_P(HardCells, KeepRelationsBesideFlatCellsThatLieAnyhow)
{
    std::size_t flat = 0;
    for (std::uint64_t seed = 1; seed <= 60 && !HasFailure(); ++seed) {
        // Coordinates so coarse that many cells become flat, and faces meet in all ways.
        Mesh mesh = carved_delaunay(8, 64, 0.7, seed);
        for (glm::dvec3& p : mesh.points)
            p = glm::floor(p / 16.0);
        if (mesh.cell_count() > 9)
            continue;
        const Scene scene(mesh);
        flat += scene.orientations().flat;
        expect_right(scene, fmt::format("coarse coordinates {}", seed), some_of(eyes_around(scene), seed, 4));
    }
    EXPECT_GT(flat, 20u);
}

TEST_P(HardCells, AreRightAtTheEndsOfTheRangeOfDoubles)
{
    for (const double scale : {std::numeric_limits<double>::denorm_min(), 0x1p-1060, 0x1p-1000, 0x1p-540, 0x1p1010})
        for (std::uint64_t seed = 1; seed <= 2; ++seed) {
            Mesh mesh = carved_delaunay(6, 16, 0.8, seed);
            for (glm::dvec3& p : mesh.points)
                p *= scale;
            const Scene scene(mesh);
            expect_right(scene, fmt::format("mesh {} of scale {}", seed, scale), eyes_around(scene));
        }
}

TEST_P(HardCells, AreSeenTheSameWithAnyWeightOfTheEye)
{
    for (const double scale : {1.0, 0x1p-500})
        for (const double weight : {0x1p-664, 0x1p-200, -0x1p-664, 0x1p300}) {
            Mesh mesh = carved_delaunay(7, 16, 0.8, 5);
            for (glm::dvec3& p : mesh.points)
                p *= scale;
            const Scene scene(mesh);
            std::vector<glm::dvec4> eyes{{0, 0, 0, 1}};
            for (const glm::dvec4& eye : eyes_around(scene))
                if (eye.w == 1 && eye * weight / weight == eye)
                    eyes.push_back(eye);
            expect_right(scene, fmt::format("scale {}, weight {}", scale, weight), eyes, weight);
        }
}

INSTANTIATE_TEST_SUITE_P(All, HardCells, testing::Values("newell", "xmpvo-exact", "bsp-xmpvo"), [](const auto& test) {
    std::string name = test.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

} // namespace
} // namespace visorder::tests
