#include "layering/xmpvo_layered.h"

#include "mpvo/mpvo.h"
#include "sorting/boundary_relations.h"
#include "tests/checking/expectations.h"
#include "tests/checking/generated.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

TEST(XmpvoLayered, FindsOnlyTrueRelations)
{
    for (const char* specification : {"carved:1500", "cavity:2000", "contact:800", "reactor:1200", "pinwheel"})
        for (const bool whole : {false, true}) {
            const Scene scene(whole ? generate(specification) : subdivide(generate(specification)).mesh);
            if (!scene.traits().planar_faces)
                continue;
            XmpvoLayered sorter(scene, GlPlatform::automatic, {128, 128});
            Order order;
            BoundaryRelations exact;
            for (const NamedView& view : all_views(scene)) {
                SCOPED_TRACE(std::string(specification) + (whole ? ", whole, " : ", ") + view.name);
                sorter.sort(view.view, order);
                EXPECT_EQ(order.back_to_front.size(), scene.cell_count());
                boundary_relations(scene, view.view.eye, exact);
                EXPECT_TRUE(std::is_sorted(sorter.relations().begin(), sorter.relations().end()));
                EXPECT_TRUE(std::includes(exact.relations.begin(), exact.relations.end(), sorter.relations().begin(),
                                          sorter.relations().end()));
            }
        }
}

TEST(XmpvoLayered, LeavesFewerViolationsTheLargerTheImage)
{
    for (const char* specification : {"carved:4000", "fin:4000", "reactor:4000"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        const OrderChecker checker(scene);
        Mpvo mpvo(scene);
        XmpvoLayered coarse(scene, GlPlatform::automatic, {64, 64}), fine(scene, GlPlatform::automatic, {512, 512});
        EXPECT_EQ(fine.guarantee(), Guarantee::approximate);
        std::size_t without = 0, with_coarse = 0, with_fine = 0, relations = 0;
        for (const NamedView& view : random_views(scene, 4, 1, {64, 64})) {
            Order order;
            const Relations all = checker.relations_at(view.view.eye);
            const auto violations = [&](Sorter& sorter) {
                sorter.sort(view.view, order);
                const CheckResult result = checker.check(all, order);
                relations = result.relations;
                return result.violations;
            };
            without += violations(mpvo);
            with_coarse += violations(coarse);
            with_fine += violations(fine);
        }
        EXPECT_LT(with_coarse * 2, without) << specification;
        EXPECT_LT(with_fine * 20, without) << specification;
        EXPECT_LT(with_fine * 250, relations) << specification; // of four views: less than a thousandth
    }
}

TEST(XmpvoLayered, FindsRelationsBetweenBlocksThatTouch)
{
    const Scene scene(subdivide(generate("contact:2000")).mesh);
    const OrderChecker checker(scene);
    Mpvo mpvo(scene);
    XmpvoLayered layered(scene, GlPlatform::automatic, {512, 512});
    std::size_t without = 0, with = 0;
    for (const NamedView& view : random_views(scene, 6, 1, {64, 64})) {
        Order order;
        const Relations relations = checker.relations_at(view.view.eye);
        mpvo.sort(view.view, order);
        without += checker.check(relations, order).violations;
        layered.sort(view.view, order);
        with += checker.check(relations, order).violations;
    }
    EXPECT_GT(without, 100u);
    EXPECT_LT(with * 20, without);
}

TEST(XmpvoLayered, OrdersConvexMeshesAsMpvoDoes)
{
    for (const char* specification : {"delaunay:2000", "grid:600"}) {
        const Scene scene(generate(specification));
        XmpvoLayered layered(scene, GlPlatform::automatic, {0, 0});
        Mpvo mpvo(scene);
        EXPECT_EQ(layered.guarantee(), Guarantee::exact);
        Order order, expected;
        for (const NamedView& view : all_views(scene)) {
            layered.sort(view.view, order);
            mpvo.sort(view.view, expected);
            EXPECT_EQ(order.back_to_front, expected.back_to_front) << specification << ", " << view.name;
            EXPECT_TRUE(layered.relations().empty());
        }
    }
}

TEST(XmpvoLayered, FindsTheSameOnBothPlatforms)
{
    const Scene scene(generate("carved:3000"));
    XmpvoLayered egl(scene, GlPlatform::egl, {200, 300}), osmesa(scene, GlPlatform::osmesa, {200, 300});
    for (const NamedView& view : random_views(scene, 3, 1, {64, 64})) {
        Order by_egl, by_osmesa;
        egl.sort(view.view, by_egl);
        osmesa.sort(view.view, by_osmesa);
        EXPECT_EQ(by_egl.back_to_front, by_osmesa.back_to_front) << view.name;
        EXPECT_FALSE(egl.relations().empty());
        EXPECT_TRUE(std::equal(egl.relations().begin(), egl.relations().end(), osmesa.relations().begin(),
                               osmesa.relations().end()));
        for (const char* name : {"layers", "fragments", "pairs of faces", "relations"})
            EXPECT_EQ(statistic(egl, name), statistic(osmesa, name)) << name;
    }
}

TEST(XmpvoLayered, RefusesSurfacesAndFacesThatAreNotPlanar)
{
    const Scene surface(generate("sphere:20")), gear(generate("gear-helical:900"));
    EXPECT_THROW(XmpvoLayered(surface, GlPlatform::automatic, {0, 0}), InputError);
    EXPECT_THROW(XmpvoLayered(gear, GlPlatform::automatic, {0, 0}), InputError);
}

} // namespace
} // namespace visorder::tests
