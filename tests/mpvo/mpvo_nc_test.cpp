#include "mpvo/mpvo_nc.h"

#include "geometry/exact_predicates.h"
#include "mpvo/mpvo.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "scene/face_planes.h"
#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "tests/mpvo/interior_relations.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/mesh.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <set>
#include <utility>

namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

std::vector<NamedView> all_views(const Scene& scene)
{
    std::vector<NamedView> views = hard_views(scene, {64, 64});
    for (NamedView& view : random_views(scene, 6, 2, {64, 64}))
        views.push_back(std::move(view));
    return views;
}

TEST(MpvoNc, OrdersEveryConvexSceneFromEveryHardView)
{
    for (const char* specification : {"delaunay:3000", "slivers:3000", "offset:3000", "grid:2000"})
        for (const bool whole : {false, true}) {
            const Scene scene(whole ? generate(specification) : subdivide(generate(specification)).mesh);
            const OrderChecker checker(scene);
            MpvoNc sorter(scene);
            EXPECT_EQ(sorter.guarantee(), Guarantee::exact);
            Order order;
            for (const NamedView& view : all_views(scene)) {
                SCOPED_TRACE(std::string(specification) + (whole ? ", whole, " : ", ") + view.name);
                sorter.sort(view.view, order);
                EXPECT_EQ(checker.check(view.view.eye, order).violations, 0u);
                EXPECT_TRUE(order.cycles.empty());
            }
        }
}

TEST(MpvoNc, KeepsAllInteriorRelationsElsewhere)
{
    for (const char* specification :
         {"carved:3000", "cavity:3000", "contact:2000", "post:2000", "fin:2000", "pinwheel"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        MpvoNc sorter(scene);
        EXPECT_EQ(sorter.guarantee(), Guarantee::approximate) << specification;
        Order order;
        for (const NamedView& view : all_views(scene)) {
            SCOPED_TRACE(std::string(specification) + ", " + view.name);
            sorter.sort(view.view, order);
            expect_interior_relations(scene, view.view.eye, order);
        }
    }
}

TEST(MpvoNc, GuessesMostRelationsAcrossTheOutside)
{
    for (const char* specification : {"carved:6000", "cavity:6000", "contact:4000"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        const OrderChecker checker(scene);
        Mpvo mpvo(scene);
        MpvoNc mpvo_nc(scene);
        Order order;
        std::size_t without = 0, with = 0;
        for (const NamedView& view : random_views(scene, 8, 1, {64, 64})) {
            const Relations relations = checker.relations_at(view.view.eye);
            mpvo.sort(view.view, order);
            without += checker.check(relations, order).violations;
            mpvo_nc.sort(view.view, order);
            with += checker.check(relations, order).violations;
        }
        EXPECT_LT(2 * with, without) << specification;
    }
}

// What is listed before the owner of the farthest front-facing face is hidden by it, or by nothing on the boundary.
TEST(MpvoNc, ListsFirstWhatTheFarthestSourceObstructs)
{
    const Scene scene(generate("carved:3000"));
    MpvoNc sorter(scene);
    Order order;
    for (const NamedView& view : random_views(scene, 6, 5, {64, 64})) {
        SCOPED_TRACE(view.name);
        const glm::dvec4 eye = view.view.eye;
        double farthest = -std::numeric_limits<double>::infinity();
        CellId source = 0;
        for (const CellFace& face : scene.boundary().faces) {
            if (exact_face_side(scene, face.cell, static_cast<int>(face.face), eye) != Sign::positive)
                continue;
            glm::dvec3 centre(0);
            for (PointId v : face_loop(scene.mesh(), face.cell, static_cast<int>(face.face)))
                centre += scene.mesh().points[v] / 3.0;
            const double distance = eye.w == 0 ? -glm::dot(centre, glm::dvec3(eye)) / glm::length(glm::dvec3(eye))
                                               : glm::length(centre - glm::dvec3(eye) / eye.w);
            if (distance > farthest) {
                farthest = distance;
                source = face.cell;
            }
        }
        std::set<CellId> hidden{source};
        std::vector<CellId> path{source};
        while (!path.empty()) {
            const CellId cell = path.back();
            path.pop_back();
            for (int f = 0; f < 4; ++f) {
                const CellId behind = scene.adjacency().row(cell)[static_cast<std::size_t>(f)];
                if (behind != cell && exact_face_side(scene, cell, f, eye) == Sign::negative &&
                    hidden.insert(behind).second)
                    path.push_back(behind);
            }
        }
        sorter.sort(view.view, order);
        std::set<CellId> first;
        for (std::size_t i = 0; i < hidden.size(); ++i)
            first.insert(order.back_to_front[i]);
        std::set<CellId> expected;
        for (CellId cell : hidden)
            expected.insert(scene.caller_cells()[cell]);
        EXPECT_EQ(first, expected);
    }
}

TEST(MpvoNc, ReportsTheCyclesThatMpvoReports)
{
    const Scene scene(generate("pinwheel"));
    const OrderChecker checker(scene);
    Mpvo mpvo(scene);
    MpvoNc mpvo_nc(scene);
    Order order, other;
    std::size_t broken = 0, still_broken = 0;
    for (const NamedView& view : random_views(scene, 20, 3, {64, 64})) {
        SCOPED_TRACE(view.name);
        mpvo.sort(view.view, order);
        mpvo_nc.sort(view.view, other);
        ASSERT_FALSE(order.cycles.empty());
        EXPECT_EQ(other.cycles, order.cycles);
        const Relations relations = checker.relations_at(view.view.eye);
        const CheckResult by_mpvo = checker.check(relations, order), by_mpvo_nc = checker.check(relations, other);
        broken += by_mpvo.violations + by_mpvo.violations_in_cycles;
        still_broken += by_mpvo_nc.violations + by_mpvo_nc.violations_in_cycles;
        expect_interior_relations(scene, view.view.eye, other);
    }
    EXPECT_LT(2 * still_broken, broken);
}

TEST(MpvoNc, GivesOneOrderForAnyNumberOfThreads)
{
    for (const char* specification : {"carved:60000", "pinwheel"}) {
        const Scene scene(generate(specification));
        MpvoNc first(scene);
        Order expected, order;
        for (const NamedView& view : random_views(scene, 2, 4, {64, 64})) {
            oneapi::tbb::task_arena(1).execute([&] { first.sort(view.view, expected); });
            for (int threads = 1; threads <= 4; ++threads) {
                const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                                        static_cast<std::size_t>(threads));
                MpvoNc sorter(scene);
                oneapi::tbb::task_arena(threads).execute([&] { sorter.sort(view.view, order); });
                EXPECT_EQ(order.back_to_front, expected.back_to_front) << view.name << ", " << threads << " threads";
                EXPECT_EQ(order.cycles, expected.cycles);
            }
        }
    }
}

TEST(MpvoNc, CountsItsSources)
{
    const Scene scene(generate("delaunay:500"));
    MpvoNc sorter(scene);
    Order order;
    sorter.sort(random_views(scene, 1, 1, {64, 64}).front().view, order);
    ASSERT_EQ(sorter.statistics().size(), 1u);
    EXPECT_STREQ(sorter.statistics().front().name, "sources");
    EXPECT_GT(sorter.statistics().front().value, 0);
    EXPECT_LT(sorter.statistics().front().value, static_cast<double>(scene.boundary().faces.size()));
}

TEST(MpvoNc, RefusesSurfaces)
{
    Mesh surface;
    surface.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    surface.add(CellShape::triangle, std::array{0u, 1u, 2u});
    const Scene scene(surface);
    EXPECT_THROW(MpvoNc{scene}, InputError);
}

} // namespace
} // namespace visorder::tests
