#include "xmpvo/xmpvo.h"

#include "mpvo/mpvo.h"
#include "parallel/concurrency.h"
#include "scene/boundary.h"
#include "sorting/boundary_relations.h"
#include "tests/checking/expectations.h"
#include "tests/checking/generated.h"
#include "tests/mpvo/interior_relations.h"
#include "tests/scene/meshes.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/sorter_options.h"

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <limits>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <string>

namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

TEST(Xmpvo, OrdersEveryConvexSceneFromEveryHardView)
{
    for (const char* specification : {"delaunay:2000", "slivers:2000", "offset:2000", "grid:2000"})
        for (const bool whole : {false, true}) {
            const Scene scene(whole ? generate(specification) : subdivide(generate(specification)).mesh);
            const OrderChecker checker(scene);
            Xmpvo xmpvo(scene);
            EXPECT_EQ(xmpvo.guarantee(), Guarantee::exact);
            Order order;
            for (const NamedView& view : all_views(scene)) {
                SCOPED_TRACE(std::string(specification) + (whole ? ", whole, " : ", ") + view.name);
                xmpvo.sort(view.view, order);
                EXPECT_EQ(checker.check(view.view.eye, order).violations, 0u);
                EXPECT_TRUE(order.cycles.empty());
                EXPECT_TRUE(xmpvo.relations().empty());
            }
        }
}

TEST(Xmpvo, KeepsInteriorRelationsAndFindsOnlyTrueOnes)
{
    for (const char* specification :
         {"carved:3000", "cavity:3000", "contact:1500", "post:2000", "fin:2000", "pinwheel"})
        for (const bool whole : {false, true}) {
            const Scene scene(whole ? generate(specification) : subdivide(generate(specification)).mesh);
            if (!scene.traits().planar_faces)
                continue;
            Xmpvo xmpvo(scene);
            Order order;
            BoundaryRelations exact;
            for (const NamedView& view : all_views(scene)) {
                SCOPED_TRACE(std::string(specification) + (whole ? ", whole, " : ", ") + view.name);
                xmpvo.sort(view.view, order);
                expect_interior_relations(scene, view.view.eye, order);
                boundary_relations(scene, view.view.eye, exact);
                EXPECT_TRUE(std::is_sorted(xmpvo.relations().begin(), xmpvo.relations().end()));
                EXPECT_TRUE(std::includes(exact.relations.begin(), exact.relations.end(), xmpvo.relations().begin(),
                                          xmpvo.relations().end()));
            }
        }
}

TEST(Xmpvo, LeavesFewOfTheViolationsOfMpvo)
{
    for (const char* specification : {"carved:6000", "cavity:6000", "contact:4000", "fin:4000"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        const OrderChecker checker(scene);
        Mpvo mpvo(scene);
        Xmpvo xmpvo(scene), xmpvo_faces(scene, XmpvoRays::faces);
        EXPECT_EQ(xmpvo.guarantee(), Guarantee::approximate);
        Order order;
        std::size_t without = 0, with_faces = 0, with_crossings = 0;
        for (const NamedView& view : random_views(scene, 6, 1, {64, 64})) { // perspective and parallel
            const Relations relations = checker.relations_at(view.view.eye);
            const auto violations = [&](Sorter& sorter) {
                sorter.sort(view.view, order);
                return checker.check(relations, order).violations;
            };
            without += violations(mpvo);
            with_faces += violations(xmpvo_faces);
            with_crossings += violations(xmpvo);
            EXPECT_GT(statistic(xmpvo, "rays"), statistic(xmpvo_faces, "rays"));
            EXPECT_GE(xmpvo.relations().size(), xmpvo_faces.relations().size());
        }
        RecordProperty(specification, std::to_string(without) + " " + std::to_string(with_faces) + " " +
                                          std::to_string(with_crossings));
        EXPECT_LT(100 * with_faces, without) << specification;
        EXPECT_LE(with_crossings, with_faces) << specification;
    }
}

// Hexahedra with an island in the hollow, and an eye between the two.
TEST(Xmpvo, LooksAroundFromInsideAHollow)
{
    const Mesh hollow = cubes(5, [](int x, int y, int z) {
        const bool island = x == 2 && y == 2 && z == 2;
        const bool shell = std::min({x, y, z}) == 0 || std::max({x, y, z}) == 4;
        return island || shell;
    });
    for (const bool whole : {false, true}) {
        const Scene scene(whole ? hollow : subdivide(hollow).mesh);
        const OrderChecker checker(scene);
        Xmpvo xmpvo(scene);
        Order order;
        for (const glm::dvec3& eye :
             {glm::dvec3(1.4, 1.3, 1.6), glm::dvec3(3.5, 2.51, 2.47), glm::dvec3(2.1, 3.9, 1.2)}) {
            xmpvo.sort(look_at(eye, {2.5, 2.5, 2.5}, 5), order);
            const CheckResult result = checker.check(glm::dvec4(eye, 1), order);
            EXPECT_EQ(result.violations, 0u);
            EXPECT_FALSE(xmpvo.relations().empty()) << "the island hides a part of the shell";
        }
    }
}

// The triangulations of two blocks that touch: of one distance along the ray are the exit and the entry.
TEST(Xmpvo, FindsRelationsBetweenBlocksThatTouch)
{
    const Scene scene(subdivide(generate("contact:2000")).mesh);
    const OrderChecker checker(scene);
    Mpvo mpvo(scene);
    Xmpvo xmpvo(scene);
    Order order;
    std::size_t without = 0, with = 0;
    for (const NamedView& view : all_views(scene)) {
        const Relations relations = checker.relations_at(view.view.eye);
        mpvo.sort(view.view, order);
        without += checker.check(relations, order).violations;
        xmpvo.sort(view.view, order);
        with += checker.check(relations, order).violations;
    }
    EXPECT_LT(100 * with, without);
}

TEST(Xmpvo, GivesOneOrderForAnyNumberOfThreads)
{
    const Scene scene(generate("carved:8000"));
    Order expected, order;
    for (const NamedView& view : random_views(scene, 2, 4, {64, 64})) {
        Xmpvo first(scene);
        first.sort(view.view, expected);
        for (int threads = 1; threads <= 4; ++threads) {
            const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
            oneapi::tbb::task_arena arena(threads);
            arena.execute([&] {
                Xmpvo sorter(scene);
                for (int run = 0; run < 2; ++run) {
                    sorter.sort(view.view, order);
                    EXPECT_EQ(order.back_to_front, expected.back_to_front) << view.name << ", " << threads;
                    EXPECT_TRUE(std::equal(sorter.relations().begin(), sorter.relations().end(),
                                           first.relations().begin(), first.relations().end()));
                    for (const Statistic& s : first.statistics())
                        EXPECT_EQ(statistic(sorter, s.name), s.value) << s.name;
                }
            });
        }
    }
}

// Embree flushes denormal numbers to zero while it works; exact predicates must not.
TEST(Xmpvo, LeavesThreadsAndTheirArithmeticAsTheyWere)
{
    const Scene scene(generate("carved:8000"));
    const std::size_t threads = concurrency();
    Xmpvo xmpvo(scene);
    Order order;
    xmpvo.sort(random_views(scene, 1, 1, {64, 64}).front().view, order);
    EXPECT_EQ(concurrency(), threads);
    std::atomic<int> flushed = 0;
    oneapi::tbb::parallel_for(0, 1000, [&](int) {
        const volatile double least = std::numeric_limits<double>::min();
        flushed += least / 2 == 0;
    });
    EXPECT_EQ(flushed, 0);
}

TEST(Xmpvo, CountsRaysHitsAndRelations)
{
    const Scene scene(generate("carved:2000"));
    Xmpvo xmpvo(scene, XmpvoRays::faces);
    Order order;
    xmpvo.sort(random_views(scene, 1, 1, {64, 64}).front().view, order);
    std::vector<std::string> names;
    for (const Statistic& s : xmpvo.statistics())
        names.emplace_back(s.name);
    EXPECT_EQ(names, (std::vector<std::string>{"silhouette edges", "crossings", "rays", "hits", "pairs of faces",
                                               "relations"}));
    EXPECT_EQ(statistic(xmpvo, "rays"), 4.0 * static_cast<double>(scene.boundary().faces.size()));
    EXPECT_GT(statistic(xmpvo, "hits"), statistic(xmpvo, "rays"));
    EXPECT_EQ(statistic(xmpvo, "relations"), static_cast<double>(xmpvo.relations().size()));
    EXPECT_GE(statistic(xmpvo, "pairs of faces"), statistic(xmpvo, "relations"));
    EXPECT_EQ(statistic(xmpvo, "crossings"), 0);
}

TEST(Xmpvo, ReportsTheCyclesThatMpvoReports)
{
    const Scene scene(generate("pinwheel"));
    Mpvo mpvo(scene);
    Xmpvo xmpvo(scene);
    Order order, other;
    for (const NamedView& view : random_views(scene, 20, 3, {64, 64})) {
        SCOPED_TRACE(view.name);
        mpvo.sort(view.view, order);
        xmpvo.sort(view.view, other);
        ASSERT_FALSE(order.cycles.empty());
        // More relations may widen a cycle.
        for (const auto& cycle : order.cycles)
            EXPECT_TRUE(std::any_of(other.cycles.begin(), other.cycles.end(), [&](const auto& set) {
                return std::includes(set.begin(), set.end(), cycle.begin(), cycle.end());
            }));
    }
}

TEST(Xmpvo, RefusesSurfaces)
{
    Mesh surface;
    surface.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    surface.add(CellShape::triangle, std::array{0u, 1u, 2u});
    const Scene scene(surface);
    EXPECT_THROW(Xmpvo{scene}, InputError);
}

// Bars across one another, none of which touches another: nearly every pair of their edges crosses in projection.
TEST(Xmpvo, LooksAtFourCrossingsPerBoundaryFaceAtMost)
{
    constexpr int bars = 30;
    Mesh mesh;
    for (int i = 0; i < 2 * bars; ++i) {
        const double at = 2.0 * (i / 2), depth = i;
        const auto point = [&](double along, double across, double height) {
            mesh.points.push_back(i % 2 == 0 ? glm::dvec3(along, across, height) : glm::dvec3(across, along, height));
        };
        const auto first = static_cast<PointId>(mesh.points.size());
        point(-1, at, depth);
        point(-1, at + 0.5, depth);
        point(2.0 * bars, at + 0.3, depth);
        point(-1, at + 0.25, depth + 0.5);
        mesh.add(CellShape::tetrahedron, std::array{first, first + 1, first + 2, first + 3});
    }
    const Scene scene(std::move(mesh));
    Xmpvo xmpvo(scene, XmpvoRays::crossings);
    Order order, again;
    const View view{glm::dvec4(0.01, 0.02, 1, 0), glm::dmat4(1), {64, 64}};
    xmpvo.sort(view, order);
    const std::size_t faces = scene.boundary().faces.size();
    ASSERT_EQ(faces, 8u * bars);
    const auto statistics = xmpvo.statistics();
    const auto crossings = std::find_if(statistics.begin(), statistics.end(), [](const Statistic& statistic) {
        return std::string_view(statistic.name) == "crossings";
    });
    ASSERT_NE(crossings, statistics.end());
    EXPECT_GT(crossings->whole, 10.0 * static_cast<double>(faces)) << "more than are looked at";
    EXPECT_GT(crossings->value, 3.5 * static_cast<double>(faces));
    EXPECT_LT(crossings->value, 4.5 * static_cast<double>(faces));
    Xmpvo other(scene, XmpvoRays::crossings);
    other.sort(view, again);
    EXPECT_EQ(order.back_to_front, again.back_to_front) << "the same sample each time";
    // Some crossings show relations that rays through faces do not.
    Xmpvo through_faces(scene, XmpvoRays::faces);
    Order by_faces;
    through_faces.sort(view, by_faces);
    const OrderChecker checker(scene);
    EXPECT_LT(checker.check(view.eye, order).violations, checker.check(view.eye, by_faces).violations);
}

} // namespace
} // namespace visorder::tests
