#include "layers_of.h"
#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "sorting/strongly_connected.h"
#include "tests/checking/small_scenes.h"
#if defined(VISORDER_WITH_VTK)
#include "visorder/read_mesh.h"
#endif

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace visorder::tests {

using namespace detail;

using namespace bench;

using namespace scenes;
namespace {

// Holds against the truth, and the variants and platforms against each other.
void expect_true_from_all_sides(const std::string& name, const Mesh& mesh, int views, glm::ivec2 size)
{
    const Scene scene(mesh);
    for (const NamedView& view : random_views(scene, views, 5, size)) {
        SCOPED_TRACE(name + ", " + view.name);
        const Layers layers = layers_of(mesh, view.view, size);
        const LayerCheck check = expect_true(mesh, view.view, size, layers);
        EXPECT_GT(check.pairs, 1000u);
        EXPECT_LT(check.ties * 1000, check.pairs);
        for (Extraction extraction : every_variant)
            for (const GlPlatform platform : {GlPlatform::egl, GlPlatform::osmesa}) {
                extraction.platform = platform;
                if (extraction.block != 64 && platform == GlPlatform::osmesa)
                    continue;
                SCOPED_TRACE(words(extraction));
                expect_same(layers_of(mesh, view.view, size, extraction), layers);
            }
    }
}

TEST(LayerExtraction, PutsEveryTriangleBehindAllThatCoverIt)
{
    for (const char* specification : {"sphere:1000", "knot:1500", "shells:1500"})
        expect_true_from_all_sides(specification, generate(specification), 1, {256, 256});
    for (const char* specification : {"sphere:300", "knot:300"})
        expect_true_from_all_sides(specification, generate(specification), 2, {90, 140});
}

TEST(LayerExtraction, IsRightAtFiveHundredAndTwelvePixels)
{
    expect_true_from_all_sides("shells:600", generate("shells:600"), 1, {512, 512});
}

#if defined(VISORDER_WITH_VTK)
TEST(LayerExtraction, IsRightOnRealModels)
{
    const std::filesystem::path folder = std::filesystem::path(VISORDER_DATA_DIR) / "surfaces";
    if (!std::filesystem::exists(folder))
        GTEST_SKIP() << "needs " << folder;
    for (const char* file : {"suzanne.obj", "teapot.obj"})
        expect_true_from_all_sides(file, read_mesh(folder / file).mesh, 1, {256, 256});
}
#endif

TEST(LayerExtraction, LeavesOnlyTrueCyclesWithoutProof)
{
    const Mesh mesh = generate("cards:150");
    const Scene scene(mesh);
    constexpr glm::ivec2 size(160, 120);
    std::size_t in_cycles = 0;
    for (const NamedView& view : random_views(scene, 4, 3, size)) {
        SCOPED_TRACE(view.name);
        const Layers layers = layers_of(mesh, view.view, size);
        expect_true(mesh, view.view, size, layers);
        for (const Extraction& extraction : every_variant)
            expect_same(layers_of(mesh, view.view, size, extraction), layers);
        // The sets of triangles each in front of another, somewhere in the image.
        const std::vector<TrueFragment> fragments = true_fragments(mesh, view.view, size);
        std::vector<std::uint32_t> from, to;
        for (std::size_t i = 1; i < fragments.size(); ++i)
            if (fragments[i].pixel == fragments[i - 1].pixel) {
                from.push_back(fragments[i - 1].triangle);
                to.push_back(fragments[i].triangle);
            }
        const Components sets = strongly_connected_components(graph_of(scene.cell_count(), from, to));
        std::map<std::uint32_t, std::vector<std::uint32_t>> members;
        for (std::uint32_t triangle = 0; triangle < scene.cell_count(); ++triangle)
            members[sets.of_node[triangle]].push_back(triangle);
        std::vector<std::vector<std::uint32_t>> expected;
        for (const auto& [set, triangles] : members)
            if (triangles.size() > 1)
                expected.push_back(triangles);
        std::sort(expected.begin(), expected.end());
        EXPECT_EQ(layers.cycles, expected);
        std::size_t counted = 0;
        for (const auto& cycle : layers.cycles)
            counted += cycle.size();
        EXPECT_EQ(count_of(layers, WithoutProof::cycle), counted);
        in_cycles += counted;
    }
    EXPECT_GT(in_cycles, 20u);
}

TEST(LayerExtraction, GivesALayerByTheLongestChainInFront)
{
    const Mesh mesh = generate("knot:300");
    const Scene scene(mesh);
    constexpr glm::ivec2 size(200, 200);
    for (const NamedView& view : random_views(scene, 3, 8, size)) {
        SCOPED_TRACE(view.name);
        const Layers layers = layers_of(mesh, view.view, size);
        ASSERT_TRUE(layers.cycles.empty());
        const std::vector<TrueFragment> fragments = true_fragments(mesh, view.view, size);
        std::vector<std::uint32_t> expected(scene.cell_count(), 0);
        for (const TrueFragment& fragment : fragments)
            expected[fragment.triangle] = 1;
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t i = 1; i < fragments.size(); ++i)
                if (fragments[i].pixel == fragments[i - 1].pixel &&
                    expected[fragments[i].triangle] <= expected[fragments[i - 1].triangle]) {
                    expected[fragments[i].triangle] = expected[fragments[i - 1].triangle] + 1;
                    changed = true;
                }
        }
        EXPECT_EQ(layers.layer, expected);
        EXPECT_EQ(layers.count, *std::max_element(expected.begin(), expected.end()));
    }
}

// As printed, the paper's step 4 takes t and u off in one pass, and then finds x covered by nothing.
TEST(LayerExtraction, DoesNotForgetWhatATriangleTakenOffCovers)
{
    const auto bar = [](double left, double right, double low, double high, double z) {
        return std::vector<glm::dvec3>{{left, low, z}, {2 * right - left, low, z}, {left, 2 * high - low, z}};
    };
    std::vector<glm::dvec3> corners;
    for (const auto& triangle : {bar(0, 3, 0, 3, 1),     // t: seen at its left and lower rim
                                 bar(0.5, 3, 0.5, 3, 2), // x: likewise
                                 bar(1, 4, 1, 3, 3),     // u: covers both, and is seen on its left
                                 bar(4, 7, 1, 2, 4)})    // v: covers the right end of u
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    const Mesh mesh = triangles(corners);
    const View view = parallel({0, 0, 1}, {5, 3, 2}, 6);
    for (const Extraction& extraction : every_variant) {
        SCOPED_TRACE(words(extraction));
        const Layers layers = layers_of(mesh, view, {128, 128}, extraction);
        EXPECT_EQ(layers.layer, (std::vector<std::uint32_t>{4, 3, 2, 1}));
        EXPECT_TRUE(layers.unproven.empty());
    }
}

TEST(LayerExtraction, ReadsNoMoreThanItNeeds)
{
    // A small sphere in one quarter of the image.
    Mesh mesh = generate("sphere:300");
    for (glm::dvec3& point : mesh.points)
        point = 0.3 * point - glm::dvec3(0.5, 0.5, 0);
    const Scene scene(mesh);
    const View view = parallel({0, 0, 1}, {0, 0, 0}, 1);
    constexpr glm::ivec2 size(512, 512);
    constexpr std::size_t all = 512 * 512;
    const auto work = [&](const Extraction& extraction) {
        LayersSorter sorter(scene, extraction.variant, extraction.platform, size, extraction.block);
        Order order;
        sorter.sort(view, order);
        EXPECT_EQ(sorter.layers().count, 2u);
        return sorter.work();
    };
    const LayerWork naive = work({LayerVariant::naive});
    // For each of two layers once the nearest image, and the farthest one with the stencil buffer.
    EXPECT_EQ(naive.passes, 4u);
    EXPECT_EQ(naive.pixels_read, 6 * all);
    const LayerWork blocked = work({LayerVariant::blocked});
    EXPECT_LE(blocked.pixels_read, all + 5 * all / 4);
    EXPECT_EQ(blocked.flags_read, 0u);
    const LayerWork compute = work({LayerVariant::compute});
    EXPECT_EQ(compute.pixels_read, 0u);
    EXPECT_EQ(compute.fragments_read, 0u);
    EXPECT_LE(compute.flags_read, compute.passes * ((scene.cell_count() + 31) / 32 + 4));
    EXPECT_EQ(compute.passes, naive.passes);
}

} // namespace
} // namespace visorder::tests
