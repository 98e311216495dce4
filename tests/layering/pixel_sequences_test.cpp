#include "layering/pixel_sequences.h"

#include "bench/layer_truth.h"
#include "scenes/generated_scene.h"
#include "visorder/scene.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace visorder::tests {

using namespace detail;

using namespace bench;
using namespace scenes;
namespace {

using Sequence = std::vector<std::pair<std::uint32_t, std::uint32_t>>; // pixel, item

struct Drawn {
    Sequence sequence;
    int passes;
};

Drawn drawn(const Context& context, const Scene& scene, const View& view, glm::ivec2 size, const PixelRectangle& within,
            std::uint32_t capacity)
{
    const ItemMesh items = surface_items(scene);
    const std::vector<std::uint8_t> wanted(items.item_count(), 1);
    ImageTriangles triangles;
    project(items, wanted, scene.mesh().points, view.world_to_clip, size, triangles);
    ItemBuffer buffer(context);
    buffer.set(triangles, size);
    PixelSequences sequences(buffer, capacity);
    std::vector<std::uint32_t> all(items.item_count());
    std::iota(all.begin(), all.end(), 0u);
    Sequence sequence;
    sequences.visit(all, within, [&](std::span<const Fragment> pixel) {
        for (const Fragment& fragment : pixel) {
            EXPECT_EQ(fragment.pixel, pixel.front().pixel);
            sequence.emplace_back(fragment.pixel, fragment.item);
        }
    });
    context.check();
    return {sequence, sequences.passes()};
}

TEST(PixelSequences, AreThoseOfTheTruthHoweverShortTheLists)
{
    constexpr glm::ivec2 size(70, 50);
    const Mesh mesh = generate("knot:300");
    const Scene scene(mesh);
    for (const GlPlatform platform : {GlPlatform::egl, GlPlatform::osmesa}) {
        const Context context(platform);
        const Context::Current current(context);
        for (const View& view : {look_at({2, 3, 9}, {0, 0, 0}, 4, 30, size), parallel({1, 2, 3}, {0, 0, 0}, 4, size)}) {
            Sequence expected;
            for (const TrueFragment& fragment : true_fragments(mesh, view, size))
                expected.emplace_back(fragment.pixel, fragment.triangle);
            ASSERT_GT(expected.size(), 1000u);
            const PixelRectangle whole{glm::ivec2(0), size};
            const Drawn at_once = drawn(context, scene, view, size, whole, 1 << 16);
            EXPECT_EQ(at_once.sequence, expected);
            EXPECT_EQ(at_once.passes, 1);
            Drawn in_parts = drawn(context, scene, view, size, whole, 100);
            EXPECT_GT(in_parts.passes, 20);
            std::stable_sort(in_parts.sequence.begin(), in_parts.sequence.end(),
                             [](const auto& a, const auto& b) { return a.first < b.first; });
            EXPECT_EQ(in_parts.sequence, expected);
            std::erase_if(expected, [](const auto& fragment) {
                const std::uint32_t x = fragment.first % 70, y = fragment.first / 70;
                return x < 20 || x >= 45 || y < 10 || y >= 40;
            });
            EXPECT_EQ(drawn(context, scene, view, size, {{20, 10}, {25, 30}}, 1 << 16).sequence, expected);
            EXPECT_THROW(drawn(context, scene, view, size, whole, 1), GraphicsError);
        }
    }
}

} // namespace
} // namespace visorder::tests
