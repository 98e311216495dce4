#include "mpvo/mpvo.h"

#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

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

void expect_no_violation(const std::string& name, const Mesh& mesh)
{
    const Scene scene(mesh);
    const OrderChecker checker(scene);
    Mpvo mpvo(scene);
    ASSERT_EQ(mpvo.guarantee(), Guarantee::exact) << name;
    Order order;
    for (const NamedView& view : all_views(scene)) {
        SCOPED_TRACE(name + ", " + view.name);
        mpvo.sort(view.view, order);
        const CheckResult result = checker.check(view.view.eye, order);
        EXPECT_GT(result.relations, 0u);
        EXPECT_EQ(result.violations, 0u);
        EXPECT_TRUE(order.cycles.empty());
        EXPECT_TRUE(result.order_exists());
    }
}

TEST(Mpvo, OrdersEveryConvexSceneFromEveryHardView)
{
    for (const char* specification : {"delaunay:4000", "delaunay:4000:7", "slivers:4000", "offset:4000", "grid:3000"}) {
        expect_no_violation(specification, subdivide(generate(specification)).mesh);
        if (std::string(specification).starts_with("grid"))
            expect_no_violation("grid of boxes", generate(specification));
    }
}

TEST(Mpvo, CallsItselfApproximateWhereRaysLeaveAndComeBack)
{
    for (const char* specification : {"carved:3000", "cavity:3000", "contact:2000", "post:2000", "fin:2000"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        EXPECT_EQ(Mpvo(scene).guarantee(), Guarantee::approximate) << specification;
    }
    const Scene scene(generate("carved:3000"));
    Mpvo mpvo(scene);
    Order order;
    std::size_t violations = 0;
    for (const NamedView& view : random_views(scene, 4, 1, {64, 64})) {
        mpvo.sort(view.view, order);
        violations += OrderChecker(scene).check(view.view.eye, order).violations;
    }
    EXPECT_GT(violations, 0u);
}

TEST(Mpvo, ReportsThePinwheelAsACycleFromEveryFarEye)
{
    const Scene scene(generate("pinwheel"));
    const OrderChecker checker(scene);
    Mpvo mpvo(scene);
    Order order;
    for (const NamedView& view : random_views(scene, 40, 3, {64, 64})) {
        SCOPED_TRACE(view.name);
        mpvo.sort(view.view, order);
        ASSERT_FALSE(order.cycles.empty());
        const CheckResult result = checker.check(view.view.eye, order);
        EXPECT_FALSE(result.order_exists());
        // What adjacency shows lies within what all relations show.
        for (const auto& cycle : order.cycles) {
            EXPECT_GT(cycle.size(), 2u);
            EXPECT_TRUE(std::any_of(result.unorderable.begin(), result.unorderable.end(), [&](const auto& set) {
                return std::includes(set.begin(), set.end(), cycle.begin(), cycle.end());
            }));
        }
        EXPECT_EQ(std::set<CellId>(order.back_to_front.begin(), order.back_to_front.end()).size(), scene.cell_count());
    }
}

TEST(Mpvo, RefusesSurfaces)
{
    Mesh surface;
    surface.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    surface.add(CellShape::triangle, std::array{0u, 1u, 2u});
    const Scene scene(surface);
    EXPECT_THROW(Mpvo{scene}, InputError);
}

} // namespace
} // namespace visorder::tests
