#include "depth/centroid.h"
#include "depth/power.h"
#include "depth/sortable_key.h"
#include "scene/circumspheres.h"
#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "visorder/checking.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <oneapi/tbb/global_control.h>

namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

TEST(SortableKey, DescendsAsNumbersAscend)
{
    const double inf = std::numeric_limits<double>::infinity();
    const std::vector<double> ascending{-inf, -1e30, -1, -1e-30, -0.0, 0.0, 1e-30, 1, 1e30, inf};
    for (std::size_t i = 1; i < ascending.size(); ++i) {
        EXPECT_GT(descending_key(ascending[i - 1]), descending_key(ascending[i])) << ascending[i];
        EXPECT_GT(descending_key(static_cast<float>(ascending[i - 1])),
                  descending_key(static_cast<float>(ascending[i])));
    }
}

TEST(Centroid, SortsByDistanceOfCentres)
{
    const Mesh mesh = generate("carved:3000");
    const Scene scene(mesh);
    Centroid centroid(scene);
    Order order;
    for (const NamedView& view : random_views(scene, 6, 1, {64, 64})) {
        centroid.sort(view.view, order);
        ASSERT_EQ(order.back_to_front.size(), mesh.cell_count());
        double last = std::numeric_limits<double>::infinity();
        for (CellId cell : order.back_to_front) {
            glm::dvec3 centre(0);
            for (PointId p : mesh.cell(cell))
                centre += mesh.points[p] / 4.0;
            const glm::dvec3 eye(view.view.eye);
            const double distance = view.view.eye.w == 0 ? -glm::dot(centre, eye) : glm::length(centre - eye);
            ASSERT_LE(distance, last + 1e-5) << view.name; // single-precision keys
            last = distance;
        }
    }
}

TEST(Power, HasNoViolationOnDelaunayScenesFromRandomViews)
{
    for (const char* specification : {"delaunay:20000", "carved:10000", "cavity:10000"}) {
        const Scene scene(generate(specification));
        const OrderChecker checker(scene);
        Power power(scene);
        EXPECT_EQ(power.guarantee(), Guarantee::approximate);
        Order order;
        for (const NamedView& view : random_views(scene, 10, 4, {64, 64})) {
            power.sort(view.view, order);
            EXPECT_EQ(checker.check(view.view.eye, order).violations, 0u) << specification << ", " << view.name;
        }
    }
}

TEST(Power, PaysForTiesOnAGridOfTetrahedraOnly)
{
    // Whole boxes have spheres of their own; the tetrahedra of a box have that of the box in common.
    for (bool whole : {true, false}) {
        const Mesh boxes = generate("grid:3000");
        const Scene scene(whole ? boxes : subdivide(boxes).mesh);
        EXPECT_EQ(scene.circumspheres().stand_ins, 0u);
        Power power(scene);
        Order order;
        std::size_t violations = 0;
        for (const NamedView& view : random_views(scene, 4, 4, {64, 64})) {
            power.sort(view.view, order);
            violations += OrderChecker(scene).check(view.view.eye, order).violations;
        }
        EXPECT_EQ(violations > 0, !whole);
    }
}

TEST(DepthSorts, GiveTheSameOrderForAnyNumberOfThreads)
{
    const Scene scene(generate("delaunay:150000"));
    Centroid centroid(scene);
    Power power(scene);
    for (const NamedView& view : random_views(scene, 2, 1, {64, 64}))
        for (Sorter* sorter : {static_cast<Sorter*>(&centroid), static_cast<Sorter*>(&power)}) {
            Order one, other;
            {
                const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, 1);
                sorter->sort(view.view, one);
            }
            sorter->sort(view.view, other);
            EXPECT_EQ(one.back_to_front, other.back_to_front) << view.name;
        }
}

} // namespace
} // namespace visorder::tests
