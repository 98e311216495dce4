#include "depth/newell.h"
#include "scene/adjacency.h"
#include "scene/orientations.h"
#include "tests/checking/expectations.h"
#include "tests/checking/generated.h"
#include "tests/checking/small_scenes.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <oneapi/tbb/global_control.h>

namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

// Sorts with and without windows: no relation may be violated, the cycles must be those of the relations, and every
// pair must have been settled by some test.
void expect_right_orders(const Scene& scene, const std::string& name, const std::vector<glm::dvec4>& eyes)
{
    const OrderChecker checker(scene);
    for (const bool windows : {false, true}) {
        Newell newell(scene, windows);
        EXPECT_EQ(newell.guarantee(), scene.overlapping_cells().empty() ? Guarantee::exact : Guarantee::approximate)
            << name;
        for (const glm::dvec4& eye : eyes) {
            SCOPED_TRACE(reproduce(name, eye) + (windows ? ", windows" : ""));
            expect_right_order(checker, newell, eye);
            double settled = 0;
            for (const Statistic& s : newell.statistics())
                if (std::string(s.name).starts_with("settled"))
                    settled += s.value;
            EXPECT_EQ(settled, statistic(newell, "pairs"));
            if (testing::Test::HasFailure())
                return;
        }
    }
}

TEST(Newell, HasNoViolationOnAThousandSmallScenes)
{
    for (std::uint64_t seed = 1; seed <= 1000 && !HasFailure(); ++seed) {
        const Scene scene(small_scene(seed));
        expect_right_orders(scene, fmt::format("small scene {}", seed),
                            some_of(small_scene_eyes(scene, seed), seed, 5));
    }
}

TEST(Newell, AgreesWithTheDefinitionOfObstruction)
{
    for (std::uint64_t seed = 1; seed <= 200 && !HasFailure(); ++seed) {
        const Scene scene(small_scene(seed));
        Newell newell(scene, seed % 2 == 0);
        for (const glm::dvec4& eye : some_of(small_scene_eyes(scene, seed), seed, 7)) {
            SCOPED_TRACE(reproduce(fmt::format("small scene {}", seed), eye));
            expect_no_obstruction_violated(scene, eye, sorted(newell, eye));
        }
    }
}

TEST(Newell, HasNoViolationFromHardViews)
{
    for (const GeneratedScene& family : generated_scenes()) {
        const std::string specification = small_specification(family);
        const Scene scene(subdivide(generate(specification)).mesh);
        if (Newell(scene).guarantee() != Guarantee::exact)
            continue;
        std::vector<glm::dvec4> eyes;
        for (const NamedView& view : hard_views(scene, {64, 64}))
            eyes.push_back(view.view.eye);
        expect_right_orders(scene, specification, eyes);
    }
}

TEST(Newell, TakesWholeCellsOfAllShapes)
{
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Scene scene(box_grid({4, 4, 4}, 2, 0.3, seed));
        expect_right_orders(scene, fmt::format("boxes {}", seed), some_of(small_scene_eyes(scene, seed), seed, 3));
        const Scene scattered(scattered_cells(60, 14, seed));
        expect_right_orders(scattered, fmt::format("scattered {}", seed), small_scene_eyes(scattered, seed));
    }
}

TEST(Newell, IsExactAtAnyPlaceAndOfAnySize)
{
    const Mesh mesh = carved_delaunay(10, 64, 0.6, 3);
    const std::vector<glm::dvec4> eyes = small_scene_eyes(Scene(mesh), 3);
    struct Map {
        double scale;
        glm::dvec3 shift;
    };
    const double away = 64e9; // a billion sizes, where integers are still exact
    for (const Map& map : {Map{1, {away, -away, away / 2}}, Map{0x1p-600, {0, 0, 0}}, Map{0x1p700, {0, 0, 0}}}) {
        Mesh moved = mesh;
        for (glm::dvec3& p : moved.points)
            p = p * map.scale + map.shift;
        std::vector<glm::dvec4> moved_eyes;
        for (const glm::dvec4& eye : eyes)
            moved_eyes.emplace_back(eye.w == 0 ? glm::dvec3(eye) : glm::dvec3(eye) * map.scale + map.shift, eye.w);
        const Scene scene(moved);
        expect_right_orders(scene, fmt::format("a mesh {} times as large at {}", map.scale, map.shift.x), moved_eyes);
    }
}

TEST(Newell, TakesEyesOfAnyWeight)
{
    const Scene scene(carved_delaunay(10, 64, 0.6, 5));
    std::vector<glm::dvec4> eyes{{1e-200, 2e-200, -1e-200, 0}, {1e200, 3e200, 2e200, 0}, {1e150, 3e150, 2e150, 1},
                                 {1e305, 3e305, 2e305, 1},     {1, 1e-9, 0, 0},          {32, 32, 32, 1}};
    for (const double w : {3.0, 0.1, -1.7, -1.0, 1e-30}) {
        eyes.emplace_back(glm::dvec3(20, 90, -40) * w, w);
        eyes.emplace_back(glm::dvec3(30, 31, 29) * w, w);
    }
    expect_right_orders(scene, "carved delaunay", eyes);
}

TEST(Newell, SeesAllAroundFromACavity)
{
    const Scene scene(generate("cavity:3000"));
    const glm::dvec3 middle = scene.bounds().middle(), size = scene.bounds().max - scene.bounds().min;
    std::vector<glm::dvec4> eyes;
    for (const glm::dvec3& at :
         {glm::dvec3(0), glm::dvec3(0.2, 0, 0), glm::dvec3(0.1, 0.25, -0.1), glm::dvec3(0, -0.3, 0.2)})
        eyes.emplace_back(middle + at * size, 1);
    expect_right_orders(scene, "cavity:3000", eyes);
}

TEST(Newell, ReportsTheCyclesOfAPinwheel)
{
    const Scene scene(generate("pinwheel:60"));
    std::vector<glm::dvec4> eyes;
    for (const NamedView& view : random_views(scene, 6, 2, {64, 64}))
        eyes.push_back(view.view.eye);
    expect_right_orders(scene, "pinwheel", eyes);
    Newell newell(scene);
    std::size_t cycles = 0;
    for (const glm::dvec4& eye : eyes)
        cycles += sorted(newell, eye).cycles.size();
    EXPECT_GE(cycles, eyes.size());
    EXPECT_GT(statistic(newell, "second moves"), 0);
}

TEST(Newell, ReportsThreeInterlockedBarsAsOneCycle)
{
    for (const bool solids : {true, false}) {
        const Scene scene(interlocked_bars(solids));
        const std::string name = solids ? "bars" : "triangles for bars";
        expect_right_orders(scene, name, {{0, 0, 1, 0}, {0, 0, 1000, 1}, {0, 0, -1, 0}, {1, 0, 0, 0}, {900, 20, 3, 1}});
        Newell newell(scene);
        const std::vector<std::vector<CellId>> all{{0, 1, 2}};
        EXPECT_EQ(sorted(newell, {0, 0, 1, 0}).cycles, all) << name;
        EXPECT_GT(statistic(newell, "second moves"), 0);
        EXPECT_EQ(sorted(newell, {0, 0, 1000, 1}).cycles, all) << name;
        EXPECT_TRUE(sorted(newell, {1, 0, 0, 0}).cycles.empty()) << name;
    }
}

TEST(Newell, FindsNoOrderBetweenTrianglesThatLieInOnePlaneOrTouchOrCross)
{
    const glm::dvec3 a(0, 0, 0), b(8, 0, 0), c(0, 8, 0);
    const std::vector<glm::dvec4> eyes{{0, 0, 1, 0}, {1, 2, 3, 0}, {3, 2, 40, 1}, {30, -20, 10, 1}, {2, 2, 1, 1}};
    const auto obscured = [](const Mesh& mesh, const glm::dvec4& eye) {
        const Scene scene(mesh);
        Newell newell(scene);
        sorted(newell, eye);
        return statistic(newell, "settled by the definitive test: obscured");
    };
    const Mesh coplanar = triangles({a, b, c, {1, 1, 0}, {9, 1, 0}, {1, 9, 0}});
    const Mesh twice = triangles({a, b, c, a, b, c});
    const Mesh crossing = triangles({a, b, c, {2, 2, -4}, {2, 3, 4}, {3, 2, 4}});
    const Mesh hinged = triangles({a, b, c, b, a, {4, -8, 1}});
    for (const glm::dvec4& eye : eyes) {
        EXPECT_EQ(obscured(coplanar, eye), 0) << reproduce("coplanar", eye);
        EXPECT_EQ(obscured(twice, eye), 0) << reproduce("twice the same", eye);
    }
    EXPECT_EQ(obscured(crossing, {0, 0, 1, 0}), 0);
    EXPECT_EQ(obscured(hinged, {0, 0, 1, 0}), 0);
    for (const Mesh* mesh : {&coplanar, &twice, &crossing, &hinged})
        expect_right_orders(Scene(*mesh), "two triangles", eyes);
    // One that touches another from above covers it.
    const Mesh standing = triangles({a, b, c, {1, 1, 0}, {2, 1, 3}, {1, 2, 3}});
    expect_right_orders(Scene(standing), "standing on one", eyes);
    const Scene scene(standing);
    Newell newell(scene);
    EXPECT_EQ(sorted(newell, {0, 0, 1, 0}).back_to_front, (std::vector<CellId>{0, 1}));
    EXPECT_EQ(sorted(newell, {0, 0, -1, 0}).back_to_front, (std::vector<CellId>{1, 0}));
}

TEST(Newell, OrdersSurfaces)
{
    for (int i = 0; i < 40 && !HasFailure(); ++i) {
        const Scene scene(random_triangles(10 + i, 9, static_cast<std::uint64_t>(i)));
        expect_right_orders(scene, fmt::format("random triangles {}", i),
                            some_of(small_scene_eyes(scene, 7), static_cast<std::size_t>(i), 3));
    }
}

TEST(Newell, KeepsRelationsThroughFlatCells)
{
    const Scene scene(flat_cells());
    EXPECT_GE(scene.orientations().flat, 3u);
    expect_right_orders(scene, "flat cells", small_scene_eyes(scene, 4));
}

TEST(Newell, KeepsRelationsWhereSquashedMeshesHaveFlatAndInvertedCells)
{
    std::size_t flat = 0, inverted = 0;
    for (std::uint64_t seed = 1; seed <= 100 && !HasFailure(); ++seed) {
        const Scene scene(squashed_delaunay(seed));
        flat += scene.orientations().flat;
        inverted += scene.orientations().inverted;
        expect_right_orders(scene, fmt::format("squashed mesh {}", seed),
                            some_of(small_scene_eyes(scene, seed), seed, 4));
    }
    EXPECT_GT(flat, 100u);
    EXPECT_GT(inverted, 100u);
}

TEST(Newell, ListsEveryCellWhereCellsOverlapAndWhereFacesAreCurved)
{
    Random random(4);
    Mesh mesh = overlapping_cells(40, 9, 4);
    Mesh curved = mesh;
    for (glm::dvec3& p : curved.points)
        p += random.integer_point(0, 2);
    for (const Mesh* each : {&mesh, &curved}) {
        const Scene scene(*each);
        Newell newell(scene);
        EXPECT_EQ(newell.guarantee(), Guarantee::approximate);
        for (const glm::dvec4& eye : small_scene_eyes(scene, 6)) {
            Order order = sorted(newell, eye);
            std::sort(order.back_to_front.begin(), order.back_to_front.end());
            std::vector<CellId> all(scene.cell_count());
            std::iota(all.begin(), all.end(), 0u);
            EXPECT_EQ(order.back_to_front, all) << reproduce("overlapping cells", eye);
        }
    }
}

TEST(Newell, KeepsTheRelationsBesideCellsThatOverlap)
{
    for (std::uint64_t seed = 1; seed <= 100 && !HasFailure(); ++seed) {
        try {
            const Scene scene(overlapping_cells(8 + static_cast<int>(seed % 20), 14, seed));
            scene.adjacency();
            expect_right_orders(scene, fmt::format("overlapping cells {}", seed),
                                some_of(small_scene_eyes(scene, seed), seed, 4));
        } catch (const InputError&) { // three cells on one face
        }
    }
}

TEST(Newell, TakesThreeCellsAtOneFace)
{
    // Two of the three overlap, and the third lies apart from these in the plane's other half.
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {1, 1, 5}, {1, 1, -5}, {2, 1, -9}};
    for (PointId apex : {3u, 4u, 5u})
        mesh.add(CellShape::tetrahedron, std::array{0u, 1u, 2u, apex});
    const Scene scene(mesh);
    EXPECT_EQ(scene.adjacency().crowded.size(), 1u);
    Newell newell(scene);
    const Order order = sorted(newell, {0, 0, 1, 0});
    EXPECT_EQ(order.back_to_front.back(), 0u);
    EXPECT_EQ(sorted(newell, {0, 0, -1, 0}).back_to_front.front(), 0u);
}

TEST(Newell, RefusesABadEye)
{
    const Scene scene(generate("delaunay:100"));
    Newell newell(scene);
    Order order;
    EXPECT_THROW(newell.sort(view_from({0, 0, 0, 0}), order), InputError);
    EXPECT_THROW(newell.sort(view_from({0, std::numeric_limits<double>::quiet_NaN(), 0, 1}), order), InputError);
}

TEST(Newell, GivesTheSameOrderAgainAndForAnyNumberOfThreads)
{
    const Scene scene(generate("carved:4000"));
    for (const bool windows : {false, true})
        for (const NamedView& view : random_views(scene, 2, 1, {64, 64})) {
            Newell newell(scene, windows), other(scene, windows);
            Order one, again;
            {
                const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 1);
                newell.sort(view.view, one);
            }
            other.sort(view_from({1, 2, 3, 0}), again);
            other.sort(view.view, again);
            EXPECT_EQ(one.back_to_front, again.back_to_front) << view.name;
        }
}

TEST(Newell, TestsFarFewerPairsWithWindows)
{
    const Scene scene(generate("carved:4000"));
    Newell plain(scene), windowed(scene, true);
    for (const NamedView& view : random_views(scene, 2, 3, {64, 64})) {
        sorted(plain, view.view.eye);
        sorted(windowed, view.view.eye);
        EXPECT_LT(2 * statistic(windowed, "pairs"), statistic(plain, "pairs")) << view.name;
        EXPECT_EQ(statistic(windowed, "moves") > 0, statistic(plain, "moves") > 0);
    }
}

} // namespace
} // namespace visorder::tests
