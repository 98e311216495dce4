#include "scene/adjacency.h"
#include "scene/face_loop.h"
#include "scene/orientations.h"
#include "tests/checking/expectations.h"
#include "tests/checking/generated.h"
#include "tests/checking/small_scenes.h"
#include "tests/scene/meshes.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/sorters.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

// What holds for every sorter that is exact on all scenes with planar faces; the parameter is its name.
class ExactSorter : public testing::TestWithParam<const char*> {
protected:
    static std::unique_ptr<Sorter> make(const Scene& scene) { return make_sorter(GetParam(), scene); }

    // One sorter over all eyes.
    static void expect_right_orders(const Scene& scene, const std::string& name, const std::vector<glm::dvec4>& eyes)
    {
        const OrderChecker checker(scene);
        const auto sorter = make(scene);
        EXPECT_EQ(sorter->guarantee(),
                  scene.overlapping_cells().empty() ? Guarantee::exact : Guarantee::exact_but_for_overlaps);
        for (const glm::dvec4& eye : eyes) {
            SCOPED_TRACE(reproduce(name, eye));
            expect_right_order(checker, *sorter, eye);
            if (HasFailure())
                return;
        }
    }

    // Of solids with small integer coordinates that do not overlap; also cut into tetrahedra, where it has no flat
    // faces to lose.
    static void expect_the_truth(const Mesh& mesh, const std::string& name, const std::vector<glm::dvec4>& eyes)
    {
        for (const bool whole : {true, false}) {
            const Scene scene(whole ? mesh : subdivide(mesh).mesh);
            expect_right_orders(scene, name + (whole ? "" : ", subdivided"), eyes);
            const auto sorter = make(scene);
            for (const glm::dvec4& eye : eyes) {
                SCOPED_TRACE(reproduce(name + (whole ? "" : ", subdivided"), eye));
                expect_no_obstruction_violated(scene, eye, sorted(*sorter, eye));
            }
        }
    }

    // That no cell obstructs another, and that none is said to.
    static void expect_no_relation(const Mesh& mesh, const std::string& name, const glm::dvec4& eye)
    {
        SCOPED_TRACE(reproduce(name, eye));
        const Scene scene(mesh);
        const auto sorter = make(scene);
        const OrderChecker checker(scene);
        expect_right_order(checker, *sorter, eye);
        EXPECT_EQ(checker.relations_at(eye).count(), 0u);
        EXPECT_EQ(statistic(*sorter, "relations"), 0);
    }
};

std::vector<glm::dvec4> eyes_of(const std::vector<NamedView>& views)
{
    std::vector<glm::dvec4> eyes;
    eyes.reserve(views.size());
    for (const NamedView& view : views)
        eyes.push_back(view.view.eye);
    return eyes;
}

TEST_P(ExactSorter, HasNoViolationOnAThousandSmallScenes)
{
    for (std::uint64_t number = 1; number <= 1000 && !HasFailure(); ++number) {
        const Scene scene(small_scene(number));
        expect_right_orders(scene, fmt::format("small scene {}", number),
                            some_of(small_scene_eyes(scene, number), number, 4));
    }
}

TEST_P(ExactSorter, AgreesWithTheDefinitionOfObstruction)
{
    for (std::uint64_t number = 1; number <= 250 && !HasFailure(); ++number) {
        const Scene scene(small_scene(number));
        const auto sorter = make(scene);
        for (const glm::dvec4& eye : some_of(small_scene_eyes(scene, number), number, 5)) {
            SCOPED_TRACE(reproduce(fmt::format("small scene {}", number), eye));
            expect_no_obstruction_violated(scene, eye, sorted(*sorter, eye));
        }
    }
}

TEST_P(ExactSorter, HasNoViolationOnEveryGeneratedSceneFromHardAndRandomViews)
{
    for (const GeneratedScene& family : generated_scenes()) {
        const std::string specification = small_specification(family);
        const Mesh mesh = generate(specification);
        for (const bool whole : {true, false}) {
            const bool triangles = mesh.shapes.front() == CellShape::triangle;
            const bool tetrahedra = mesh.shapes.front() == CellShape::tetrahedron;
            if (!whole && (triangles || tetrahedra))
                continue;
            const Scene scene(whole ? mesh : subdivide(mesh).mesh);
            if (!triangles && !scene.traits().planar_faces)
                continue;
            expect_right_orders(scene, specification + (whole ? ", whole" : ", subdivided"), eyes_of(all_views(scene)));
        }
    }
}

TEST_P(ExactSorter, TakesWholeCellsOfAllShapes)
{
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Scene boxes(box_grid({4, 4, 4}, 2, 0.3, seed));
        expect_right_orders(boxes, fmt::format("boxes {}", seed), some_of(small_scene_eyes(boxes, seed), seed, 3));
        const Scene scattered(scattered_cells(60, 14, seed));
        expect_right_orders(scattered, fmt::format("scattered cells {}", seed), small_scene_eyes(scattered, seed));
    }
    const Scene scene(zoo());
    expect_right_orders(scene, "zoo", eyes_of(all_views(scene)));
}

TEST_P(ExactSorter, OrdersBodiesInContactByTheirCoplanarFaces)
{
    // The faces lie in one plane, share a part and no point; a third block stands on the edge between two.
    Mesh mesh;
    add_box(mesh, {0, 0, 0}, {4, 4, 4});
    add_box(mesh, {4, 1, 1}, {8, 6, 6});
    add_box(mesh, {2, 2, 4}, {4, 5, 7});
    const auto place = [&](const glm::dvec4& eye, CellId cell) {
        const Scene scene(mesh);
        const auto order = sorted(*make(scene), eye).back_to_front;
        return std::find(order.begin(), order.end(), cell) - order.begin();
    };
    for (const double weight : {0.0, 1.0}) {
        EXPECT_GT(place({-20, 2, 2, weight}, 0), place({-20, 2, 2, weight}, 1));
        EXPECT_LT(place({20, 2, 2, weight}, 0), place({20, 2, 2, weight}, 1));
        EXPECT_LT(place({3, 3, 40, weight}, 0), place({3, 3, 40, weight}, 2));
        EXPECT_GT(place({3, 3, -40, weight}, 0), place({3, 3, -40, weight}, 2));
    }
    std::vector<glm::dvec4> eyes{{-20, 2, 2, 1}, {20, 2, 2, 1}, {-1, 0, 0, 0}, {1, 0, 0, 0},
                                 {3, 3, 40, 1},  {4, 3, 9, 1},  {4, -9, 3, 1}, {2, 2, 4, 1},
                                 {4, 2, 5, 1},   {4, 4, 4, 1},  {0, 3, 1, 0}};
    expect_the_truth(mesh, "blocks in contact", eyes);
}

TEST_P(ExactSorter, FindsNoRelationAcrossEdgeOnFaces)
{
    Mesh mesh;
    add_box(mesh, {0, 0, 0}, {2, 2, 2});
    add_box(mesh, {2, 0, 3}, {4, 2, 5});
    for (const glm::dvec4& eye : {glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 1, 0),
                                  glm::dvec4(2, 1, 50, 1), glm::dvec4(2, 1, -50, 1), glm::dvec4(2, 9, 30, 1)})
        expect_no_relation(mesh, "boxes on either side of a plane", eye);
    // Edge-on sides hide neither the top nor the bottom.
    add_box(mesh, {0, 0, 9}, {4, 2, 10});
    const Scene scene(mesh);
    EXPECT_EQ(sorted(*make(scene), {0, 0, 1, 0}).back_to_front.back(), 2u);
    EXPECT_EQ(sorted(*make(scene), {0, 0, -1, 0}).back_to_front.front(), 2u);
    expect_the_truth(mesh, "boxes with edge-on faces", {{0, 0, 1, 0}, {0, 0, -1, 0}, {2, 1, 50, 1}, {0, 2, 4, 1}});
}

TEST_P(ExactSorter, FindsNoRelationWhereProjectionsTouchAtAnEdgeOrAVertex)
{
    for (const bool vertex : {false, true}) {
        Mesh mesh;
        add_box(mesh, {0, 0, 4}, {2, 2, 6});
        add_box(mesh, {2, vertex ? 2 : 0, 0}, {4, 4, 2});
        expect_no_relation(mesh, vertex ? "a vertex" : "an edge", {0, 0, 1, 0});
        expect_no_relation(mesh, vertex ? "a vertex" : "an edge", {0, 0, -3, 0});
        // In perspective along the plane or the line in which they touch.
        expect_no_relation(mesh, vertex ? "a vertex" : "an edge", {2, 2, 70, 1});
        expect_no_relation(mesh, vertex ? "a vertex" : "an edge", {2, 2, -70, 1});
    }
    // Triangles of which the eye sees an edge of one on that of the other, slantwise.
    const Mesh mesh = triangles({{0, 0, 0}, {6, 6, 0}, {0, 6, 0}, {9, 0, 5}, {9, 6, 9}, {4, 4, 3}});
    expect_no_relation(mesh, "triangles", {0, 0, 1, 0});
    expect_no_relation(triangles({{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {3, 3, 8}, {9, 3, 7}, {5, 9, 8}}), "triangles",
                       {0, 0, 1, 0});
}

TEST_P(ExactSorter, LooksAroundFromInsideACavity)
{
    const Scene scene(generate("cavity:2000"));
    const glm::dvec3 middle = scene.bounds().middle(), size = scene.bounds().max - scene.bounds().min;
    std::vector<glm::dvec4> eyes;
    for (const glm::dvec3& at :
         {glm::dvec3(0), glm::dvec3(0.2, 0, 0), glm::dvec3(0.1, 0.25, -0.1), glm::dvec3(0, -0.3, 0.2)})
        eyes.emplace_back(middle + at * size, 1);
    expect_right_orders(scene, "cavity:2000", eyes);
    const Mesh hollow = cubes(5, [](int x, int y, int z) {
        const bool island = x == 2 && y == 2 && z == 2;
        const bool shell = std::min({x, y, z}) == 0 || std::max({x, y, z}) == 4;
        return island || shell;
    });
    eyes = {{1.4, 1.3, 1.6, 1}, {3.5, 2.51, 2.47, 1}, {2.1, 3.9, 1.2, 1}, {1, 1, 1, 1}, {1.5, 2, 3, 1}, {2, 1.5, 3, 1}};
    for (const bool whole : {true, false})
        expect_right_orders(Scene(whole ? hollow : subdivide(hollow).mesh), "hollow", eyes);
}

TEST_P(ExactSorter, TakesRaysThroughChainsOfEdgesAndVertices)
{
    // Cubes that meet at edges alone, and cubes that meet at vertices alone.
    const Mesh edges = cubes(4, [](int x, int y, int z) { return (x + y + z) % 2 == 0; });
    const Mesh vertices = cubes(4, [](int x, int y, int z) { return x % 2 == y % 2 && y % 2 == z % 2; });
    std::vector<glm::dvec4> eyes;
    for (const glm::dvec3& towards : {glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0), glm::dvec3(0, -1, 1),
                                      glm::dvec3(1, 1, 1), glm::dvec3(-1, 1, -1), glm::dvec3(2, 1, 0)}) {
        eyes.emplace_back(towards, 0);
        eyes.emplace_back(glm::dvec3(2) + 8.0 * towards, 1); // on a line of edges, or a diagonal
        eyes.emplace_back(glm::dvec3(1, 2, 2) + towards, 1); // at a vertex
    }
    expect_the_truth(edges, "cubes that meet at edges", eyes);
    expect_the_truth(vertices, "cubes that meet at vertices", eyes);
}

TEST_P(ExactSorter, IsExactAtAnyPlaceAndOfAnySize)
{
    const Mesh mesh = carved_delaunay(10, 64, 0.6, 3);
    const std::vector<glm::dvec4> eyes = small_scene_eyes(Scene(mesh), 3);
    struct Map {
        double scale;
        glm::dvec3 shift;
    };
    const double away = 64e9; // a billion sizes, where integers are still exact
    for (const Map& map : {Map{1, {away, -away, away / 2}}, Map{0x1p-600, {0, 0, 0}}, Map{0x1p700, {0, 0, 0}},
                           Map{0x1p1010, {0, 0, 0}}, Map{0x1p-100, {1, 2, 3}}}) {
        Mesh moved = mesh;
        for (glm::dvec3& p : moved.points)
            p = p * map.scale + map.shift;
        std::vector<glm::dvec4> moved_eyes;
        for (const glm::dvec4& eye : eyes)
            moved_eyes.emplace_back(eye.w == 0 ? glm::dvec3(eye) : glm::dvec3(eye) * map.scale + map.shift, eye.w);
        const Scene scene(moved);
        expect_right_orders(scene, fmt::format("a mesh {} times as large at {}", map.scale, map.shift.x), moved_eyes);
    }
    Mesh far = generate("carved:600");
    for (glm::dvec3& p : far.points)
        p += glm::dvec3(1e9, -2e9, 1e9); // rounded: cells may be flat or inverted
    const Scene scene(far);
    expect_right_orders(scene, "carved:600, far from the origin", eyes_of(all_views(scene)));
}

TEST_P(ExactSorter, TakesEyesOfAnyWeight)
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

TEST_P(ExactSorter, ReportsThreeInterlockedBarsAsOneCycle)
{
    for (const bool solids : {true, false}) {
        Mesh mesh = interlocked_bars(solids);
        const Scene scene(mesh);
        const std::string name = solids ? "bars" : "triangles for bars";
        expect_right_orders(scene, name, {{0, 0, 1, 0}, {0, 0, 1000, 1}, {0, 0, -1, 0}, {1, 0, 0, 0}, {900, 20, 3, 1}});
        const auto sorter = make(scene);
        const std::vector<std::vector<CellId>> all{{0, 1, 2}};
        EXPECT_EQ(sorted(*sorter, {0, 0, 1, 0}).cycles, all) << name;
        EXPECT_EQ(sorted(*sorter, {0, 0, 1000, 1}).cycles, all) << name;
        EXPECT_TRUE(sorted(*sorter, {1, 0, 0, 0}).cycles.empty()) << name;
    }
}

TEST_P(ExactSorter, OrdersWhatIsBeforeAndBehindACycle)
{
    Mesh mesh;
    for (int i = 0; i < 4; ++i)
        add_box(mesh, {-20 + 8 * i, -20, -60 + 4 * i}, {-4 + 8 * i, 20, -57 + 4 * i});
    const Mesh bars = interlocked_bars(true);
    const auto first = static_cast<PointId>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), bars.points.begin(), bars.points.end());
    for (CellId cell = 0; cell < bars.cell_count(); ++cell) {
        std::array<PointId, 8> v{};
        std::transform(bars.cell(cell).begin(), bars.cell(cell).end(), v.begin(), [&](PointId p) { return p + first; });
        mesh.add(CellShape::hexahedron, v);
    }
    add_box(mesh, {-9, -9, 40}, {9, 9, 50});
    for (const bool whole : {true, false}) {
        const Scene scene(whole ? mesh : subdivide(mesh).mesh);
        expect_right_orders(scene, whole ? "bars between boxes" : "bars between boxes, subdivided",
                            {{0, 0, 1, 0}, {0, 0, -1, 0}, {1, 2, 900, 1}, {1, 0, 0, 0}, {0, 0, -500, 1}, {0, 0, 1, 1}});
        const Order order = sorted(*make(scene), {0, 0, 1, 0});
        ASSERT_EQ(order.cycles.size(), 1u);
        EXPECT_EQ(order.cycles.front().size(), whole ? 3u : order.cycles.front().size());
        if (whole) {
            EXPECT_EQ(order.cycles.front(), (std::vector<CellId>{4, 5, 6}));
            EXPECT_EQ(order.back_to_front.back(), 7u);
        }
    }
}

TEST_P(ExactSorter, KeepsRelationsThroughFlatCells)
{
    const Scene scene(flat_cells());
    EXPECT_GE(scene.orientations().flat, 3u);
    expect_right_orders(scene, "flat cells", small_scene_eyes(scene, 4));
}

TEST_P(ExactSorter, KeepsRelationsWhereSquashedMeshesHaveFlatAndInvertedCells)
{
    std::size_t flat = 0, inverted = 0;
    for (std::uint64_t seed = 1; seed <= 100 && !HasFailure(); ++seed) {
        const Scene scene(squashed_delaunay(seed));
        flat += scene.orientations().flat;
        inverted += scene.orientations().inverted;
        expect_right_orders(scene, fmt::format("squashed mesh {}", seed),
                            some_of(small_scene_eyes(scene, seed), seed, 3));
    }
    EXPECT_GT(flat, 100u);
    EXPECT_GT(inverted, 100u);
}

TEST_P(ExactSorter, TakesCollapsedCells)
{
    // Points that were joined: edges, faces and whole cells collapse, also quadrilaterals to triangles.
    int meshes = 0;
    std::size_t collapsed = 0;
    for (std::uint64_t seed = 1; seed <= 120 && !HasFailure(); ++seed) {
        Random random(seed);
        Mesh mesh = seed % 2 == 0 ? carved_delaunay(9, 40, 0.8, seed) : whole_boxes({3, 2, 2}, 2, 0.2, seed);
        const auto cell = mesh.cell(static_cast<CellId>(random.below(static_cast<int>(mesh.cell_count()))));
        const PointId joined = cell[0], to = cell[1];
        std::replace(mesh.vertices.begin(), mesh.vertices.end(), joined, to);
        try {
            const Scene scene(mesh);
            if (!scene.traits().planar_faces)
                continue;
            for (CellId i = 0; i < scene.cell_count(); ++i)
                collapsed += is_collapsed(scene.mesh(), i);
            expect_right_orders(scene, fmt::format("joined points {}", seed),
                                some_of(small_scene_eyes(scene, seed), seed, 3));
            ++meshes;
        } catch (const InputError&) { // three cells on one face
        }
    }
    EXPECT_GT(meshes, 40);
    EXPECT_GT(collapsed, 100u);
    Mesh mesh = two_tetrahedra();
    mesh.add(CellShape::tetrahedron, std::array{0u, 0u, 0u, 0u});
    mesh.add(CellShape::tetrahedron, std::array{4u, 4u, 1u, 2u});
    const Scene scene(mesh);
    expect_right_orders(scene, "two tetrahedra and two that collapsed", eyes_of(all_views(scene)));
}

TEST_P(ExactSorter, KeepsTheRelationsBesideCellsThatOverlap)
{
    int meshes = 0;
    for (std::uint64_t seed = 1; seed <= 100 && !HasFailure(); ++seed) {
        try {
            const Scene scene(overlapping_cells(8 + static_cast<int>(seed % 20), 14, seed));
            scene.adjacency();
            expect_right_orders(scene, fmt::format("overlapping cells {}", seed),
                                some_of(small_scene_eyes(scene, seed), seed, 4));
            ++meshes;
        } catch (const InputError&) { // three cells on one face
        }
    }
    EXPECT_GT(meshes, 50);
}

TEST_P(ExactSorter, OrdersRandomTriangles)
{
    for (int i = 0; i < 40 && !HasFailure(); ++i) {
        const Scene scene(random_triangles(10 + i, i % 2 == 0 ? 9 : 40, static_cast<std::uint64_t>(i)));
        expect_right_orders(scene, fmt::format("random triangles {}", i),
                            some_of(small_scene_eyes(scene, 7), static_cast<std::size_t>(i), 3));
    }
}

TEST_P(ExactSorter, OrdersSurfacesOfManyTriangles)
{
    for (const char* specification : {"shells:3000", "knot:3000", "cards:300", "sphere:2000"}) {
        const Scene scene(generate(specification));
        expect_right_orders(scene, specification, eyes_of(random_views(scene, 4, 5, {64, 64})));
    }
}

TEST_P(ExactSorter, FindsNoOrderBetweenTrianglesThatLieInOnePlaneOrCross)
{
    const glm::dvec3 a(0, 0, 0), b(8, 0, 0), c(0, 8, 0);
    const std::vector<glm::dvec4> eyes{{0, 0, 1, 0}, {1, 2, 3, 0}, {3, 2, 40, 1}, {30, -20, 10, 1}, {2, 2, 1, 1}};
    const Mesh coplanar = triangles({a, b, c, {1, 1, 0}, {9, 1, 0}, {1, 9, 0}});
    const Mesh twice = triangles({a, b, c, a, b, c});
    const Mesh hinged = triangles({a, b, c, b, a, {4, -8, 1}});
    const Mesh crossing = triangles({a, b, c, {2, 2, -4}, {2, 3, 4}, {3, 2, 4}});
    for (const glm::dvec4& eye : eyes) {
        expect_no_relation(coplanar, "coplanar", eye);
        expect_no_relation(twice, "twice the same", eye);
    }
    expect_no_relation(hinged, "hinged", {0, 0, 1, 0});
    expect_no_relation(crossing, "crossing", {0, 0, 1, 0});
    for (const Mesh* mesh : {&coplanar, &twice, &hinged, &crossing})
        expect_right_orders(Scene(*mesh), "two triangles", eyes);
}

TEST_P(ExactSorter, OrdersTrianglesThatTouch)
{
    // One that touches another from above covers it.
    const Scene scene(triangles({{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {1, 1, 0}, {2, 1, 3}, {1, 2, 3}}));
    expect_right_orders(scene, "standing on one", {{0, 0, 1, 0}, {1, 2, 3, 0}, {3, 2, 40, 1}, {2, 2, 1, 1}});
    EXPECT_EQ(sorted(*make(scene), {0, 0, 1, 0}).back_to_front, (std::vector<CellId>{0, 1}));
    EXPECT_EQ(sorted(*make(scene), {0, 0, -1, 0}).back_to_front, (std::vector<CellId>{1, 0}));
}

TEST_P(ExactSorter, RemembersNothingOfEarlierEyes)
{
    // Of some eyes cycles are seen, of some few or all sides of the image.
    const Mesh all[] = {generate("carved:1500"), generate("pinwheel:60"), interlocked_bars(true),
                        interlocked_bars(false), generate("cards:200"),   whole_boxes({4, 4, 4}, 2, 0.4, 3)};
    for (const Mesh& mesh : all) {
        const Scene scene(mesh);
        const OrderChecker checker(scene);
        std::vector<glm::dvec4> eyes{{0, 0, 1, 0}, {1, 0, 0, 0}, glm::dvec4(scene.bounds().middle(), 1)};
        for (const NamedView& view : random_views(scene, 3, 8, {64, 64}))
            eyes.push_back(view.view.eye);
        const auto used = make(scene);
        Order order;
        order.layer_begin = {0};
        for (int round = 0; round < 2; ++round)
            for (const glm::dvec4& eye : eyes) {
                SCOPED_TRACE(reproduce(fmt::format("a mesh of {} cells", scene.cell_count()), eye));
                used->sort(view_from(eye), order);
                const Order expected = expect_right_order(checker, *make(scene), eye);
                EXPECT_EQ(order.back_to_front, expected.back_to_front);
                EXPECT_EQ(order.cycles, expected.cycles);
                EXPECT_EQ(order.layer_begin, expected.layer_begin);
            }
    }
}

TEST_P(ExactSorter, GivesOneOrderForAnyNumberOfThreads)
{
    for (const char* specification : {"carved:40000", "reactor:3000", "pinwheel:60", "shells:1000"}) {
        const Scene scene(generate(specification));
        for (const NamedView& view : random_views(scene, 2, 4, {64, 64})) {
            const Order expected = sorted(*make(scene), view.view.eye);
            for (int threads = 1; threads <= 4; ++threads) {
                const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                                        static_cast<std::size_t>(threads));
                oneapi::tbb::task_arena arena(threads);
                arena.execute([&] {
                    const auto sorter = make(scene);
                    for (int run = 0; run < 2; ++run) {
                        const Order order = sorted(*sorter, view.view.eye);
                        EXPECT_EQ(order.back_to_front, expected.back_to_front)
                            << specification << ", " << view.name << ", " << threads << " threads";
                        EXPECT_EQ(order.cycles, expected.cycles);
                    }
                });
            }
        }
    }
}

TEST_P(ExactSorter, RefusesBadEyesAndFacesThatAreNotPlanar)
{
    const Scene scene(generate("delaunay:100"));
    const auto sorter = make(scene);
    Order order;
    EXPECT_THROW(sorter->sort(view_from({0, 0, 0, 0}), order), InputError);
    EXPECT_THROW(sorter->sort(view_from({0, std::numeric_limits<double>::quiet_NaN(), 0, 1}), order), InputError);
    EXPECT_THROW(sorter->sort(view_from({0, std::numeric_limits<double>::infinity(), 0, 1}), order), InputError);
    Mesh curved = cubes(2);
    curved.points[0] += glm::dvec3(0.1, 0.2, 0.3);
    const Scene of_curved(curved);
    EXPECT_THROW(make(of_curved), InputError);
}

INSTANTIATE_TEST_SUITE_P(All, ExactSorter, testing::Values("xmpvo-exact", "bsp-xmpvo"), [](const auto& tested) {
    std::string name = tested.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

} // namespace
} // namespace visorder::tests
