#include "layering/layers_sorter.h"

#include "layers_of.h"
#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "tests/checking/expectations.h"
#include "visorder/checking.h"
#include "visorder/error.h"
#include "visorder/sorter_options.h"
#include "visorder/sorters.h"

#include <algorithm>
#include <set>
#include <thread>

namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

TEST(LayersSorter, ListsEveryTriangleOnceByLayers)
{
    for (const char* specification : {"shells:2000", "cards:200"}) {
        const Scene scene(generate(specification));
        for (const NamedView& view : random_views(scene, 3, 1, {120, 120})) {
            SCOPED_TRACE(std::string(specification) + ", " + view.name);
            LayersSorter sorter(scene, LayerVariant::blocked, GlPlatform::automatic, {0, 0}, 64);
            Order order;
            sorter.sort(view.view, order);
            const Layers& layers = sorter.layers();
            std::vector<CellId> listed = order.back_to_front;
            std::sort(listed.begin(), listed.end());
            for (CellId cell = 0; cell < scene.cell_count(); ++cell)
                ASSERT_EQ(listed[cell], cell);
            EXPECT_EQ(order.cycles, layers.cycles);
            // What has no layer stands at the back, as a layer of its own; then they come nearer.
            const std::size_t unlayered =
                count_of(layers, WithoutProof::no_sample) + count_of(layers, WithoutProof::edge_on);
            EXPECT_GT(unlayered, 0u);
            ASSERT_EQ(order.layer_begin.size(), layers.count + 1u);
            EXPECT_EQ(order.layer_begin[0], 0u);
            EXPECT_EQ(order.layer_begin[1], unlayered);
            for (std::size_t i = 0; i < order.layer_begin.size(); ++i) {
                const std::size_t end =
                    i + 1 < order.layer_begin.size() ? order.layer_begin[i + 1] : order.back_to_front.size();
                for (std::size_t k = order.layer_begin[i]; k < end; ++k)
                    EXPECT_EQ(layers.layer[order.back_to_front[k]], i == 0 ? 0 : layers.count + 1 - i);
            }
        }
    }
}

TEST(LayersSorter, LeavesFewViolationsAndFewerOnLargerImages)
{
    const Scene scene(generate("shells:600"));
    const OrderChecker checker(scene);
    std::size_t coarse = 0, fine = 0, relations = 0;
    for (const NamedView& view : random_views(scene, 2, 1, {64, 64})) {
        Order order;
        const Relations all = checker.relations_at(view.view.eye);
        const auto violations = [&](int size) {
            LayersSorter sorter(scene, LayerVariant::blocked, GlPlatform::automatic, {size, size}, 64);
            sorter.sort(view.view, order);
            const CheckResult result = checker.check(all, order);
            relations += result.relations;
            return result.violations;
        };
        coarse += violations(64);
        fine += violations(1024);
    }
    EXPECT_LT(fine * 5, coarse);
    EXPECT_LT(fine * 500, relations);
}

TEST(LayersSorter, GivesTheSameOrdersByAllNamesAndPlatforms)
{
    const Scene scene(generate("cards:120"));
    Order expected, order;
    for (const NamedView& view : random_views(scene, 2, 6, {100, 80})) {
        make_sorter("layers", scene)->sort(view.view, expected);
        for (const char* name : {"layers", "layers-blocked", "layers-compute"})
            for (const GlPlatform gl : {GlPlatform::egl, GlPlatform::osmesa}) {
                SorterOptions options;
                options.layers.gl = gl;
                options.layers.block = 32;
                make_sorter(name, scene, options)->sort(view.view, order);
                EXPECT_EQ(order.back_to_front, expected.back_to_front) << name << " on " << visorder::name(gl);
                EXPECT_EQ(order.layer_begin, expected.layer_begin);
                EXPECT_EQ(order.cycles, expected.cycles);
            }
    }
}

TEST(LayersSorter, LeaksNothingOverAThousandFrames)
{
    const Scene scene(generate("cards:30"));
    for (const LayerVariant variant : {LayerVariant::naive, LayerVariant::blocked, LayerVariant::compute}) {
        LayersSorter sorter(scene, variant, GlPlatform::automatic, {16, 16}, 64);
        Order first, order;
        const std::vector<NamedView> views = random_views(scene, 4, 2, {16, 16});
        for (const NamedView& view : views)
            sorter.sort(view.view, order);
        sorter.sort(views[0].view, first);
        const std::size_t objects = sorter.context().live_objects();
        const std::size_t bytes = sorter.bytes();
        for (std::size_t frame = 0; frame < 1000; ++frame)
            sorter.sort(views[frame % views.size()].view, order);
        EXPECT_EQ(sorter.context().live_objects(), objects);
        EXPECT_EQ(sorter.bytes(), bytes);
        sorter.sort(views[0].view, order);
        EXPECT_EQ(order.back_to_front, first.back_to_front);
    }
}

TEST(LayersSorter, WorksOnTwoThreadsAtOnceAndMovesBetweenThem)
{
    const Scene scene(generate("shells:300"));
    const std::vector<NamedView> views = random_views(scene, 6, 3, {80, 80});
    const auto orders = [&](LayersSorter& sorter) {
        std::vector<std::vector<CellId>> result;
        Order order;
        for (const NamedView& view : views) {
            sorter.sort(view.view, order);
            result.push_back(order.back_to_front);
        }
        return result;
    };
    for (const GlPlatform platform : {GlPlatform::egl, GlPlatform::osmesa}) {
        LayersSorter sorter(scene, LayerVariant::blocked, platform, {0, 0}, 32);
        const auto expected = orders(sorter);
        LayersSorter other(scene, LayerVariant::compute, platform, {0, 0}, 32);
        std::vector<std::vector<CellId>> of_sorter, of_other;
        std::thread first([&] { of_sorter = orders(sorter); });
        std::thread second([&] { of_other = orders(other); });
        first.join();
        second.join();
        EXPECT_EQ(of_sorter, expected);
        EXPECT_EQ(of_other, expected);
    }
}

TEST(LayersSorter, CountsWhatItDoes)
{
    const Scene scene(generate("cards:100"));
    std::vector<std::string> names;
    for (const LayerVariant variant : {LayerVariant::naive, LayerVariant::blocked, LayerVariant::compute}) {
        LayersSorter sorter(scene, variant, GlPlatform::automatic, {100, 100}, 32);
        Order order;
        sorter.sort(look_at({3, 2, 4}, {0.5, 0.5, 0.5}, 1), order);
        EXPECT_EQ(sorter.guarantee(), Guarantee::approximate);
        EXPECT_EQ(statistic(sorter, "layers"), sorter.layers().count);
        EXPECT_EQ(statistic(sorter, "in cycles at this resolution"),
                  static_cast<double>(count_of(sorter.layers(), WithoutProof::cycle)));
        EXPECT_GT(statistic(sorter, "fragments read"), 0) << "there are cycles";
        EXPECT_GE(statistic(sorter, "passes"), sorter.layers().count);
        EXPECT_EQ(statistic(sorter, "pixels read") > 0, variant != LayerVariant::compute);
        EXPECT_EQ(statistic(sorter, "words of flags read") > 0, variant == LayerVariant::compute);
        for (const char* seconds : {"rendering, s", "reading, s", "scanning, s", "rest, s"})
            EXPECT_GT(statistic(sorter, seconds), 0) << seconds;
        EXPECT_GT(sorter.bytes(), 100 * 100 * 16u);
    }
}

TEST(LayersSorter, RefusesSolidsAndPlatformsThatAreNone)
{
    const Scene solids(generate("delaunay:500")), surface(generate("sphere:20"));
    for (const char* name : {"layers", "layers-blocked", "layers-compute"}) {
        EXPECT_THROW(make_sorter(name, solids), InputError);
        EXPECT_NO_THROW(make_sorter(name, surface));
    }
    EXPECT_THROW(gl_platform("glx"), InputError);
}

} // namespace
} // namespace visorder::tests
