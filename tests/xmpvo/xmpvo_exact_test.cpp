#include "xmpvo/xmpvo_exact.h"

#include "mpvo/mpvo.h"
#include "sorting/boundary_relations.h"
#include "tests/checking/expectations.h"
#include "tests/checking/generated.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

// What all exact sorters have in common is tested in tests/bsp/exact_sorters_test.cpp.
namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

TEST(XmpvoExact, CountsTheBoundaryRelations)
{
    for (const char* specification : {"carved:1500", "contact:600", "cards:200"}) {
        const Scene scene(generate(specification));
        XmpvoExact sorter(scene);
        BoundaryRelations expected;
        for (const NamedView& view : all_views(scene)) {
            sorted(sorter, view.view.eye);
            boundary_relations(scene, view.view.eye, expected);
            EXPECT_EQ(statistic(sorter, "relations"), static_cast<double>(expected.relations.size()))
                << specification << ", " << view.name;
            EXPECT_EQ(statistic(sorter, "candidate pairs"), static_cast<double>(expected.candidates));
            EXPECT_GE(expected.candidates, expected.relations.size());
        }
        EXPECT_EQ(sorter.statistics().size(), 2u);
        EXPECT_GT(sorter.bytes(), 0u);
    }
}

TEST(XmpvoExact, OrdersConvexMeshesAsMpvoDoes)
{
    for (const char* specification : {"delaunay:2000", "grid:600"}) {
        const Scene scene(generate(specification));
        XmpvoExact sorter(scene);
        Mpvo mpvo(scene);
        for (const NamedView& view : all_views(scene)) {
            EXPECT_EQ(sorted(sorter, view.view.eye).back_to_front, sorted(mpvo, view.view.eye).back_to_front)
                << specification << ", " << view.name;
            EXPECT_EQ(statistic(sorter, "relations"), 0);
        }
    }
}

TEST(XmpvoExact, DerivesItsStructuresWhenItIsMade)
{
    const Scene scene(generate("carved:600"));
    XmpvoExact sorter(scene);
    const std::size_t derived = scene.derived().size();
    for (const NamedView& view : random_views(scene, 2, 1, {64, 64}))
        sorted(sorter, view.view.eye);
    EXPECT_EQ(scene.derived().size(), derived);
}

} // namespace
} // namespace visorder::tests
