#pragma once

#include "bench/layer_truth.h"
#include "layering/layers_sorter.h"

#include <gtest/gtest.h>
#include <string>

namespace visorder::tests {

using namespace detail;

/// One way of extracting layers.
struct Extraction {
    LayerVariant variant;
    GlPlatform platform = GlPlatform::automatic;
    int block = 64;
};

inline const Extraction every_variant[] = {{LayerVariant::naive},
                                           {LayerVariant::blocked, GlPlatform::automatic, 32},
                                           {LayerVariant::blocked, GlPlatform::automatic, 64},
                                           {LayerVariant::blocked, GlPlatform::automatic, 128},
                                           {LayerVariant::compute}};

inline std::string words(const Extraction& extraction)
{
    const std::string variant = extraction.variant == LayerVariant::naive     ? "layers"
                                : extraction.variant == LayerVariant::blocked ? "layers-blocked"
                                                                              : "layers-compute";
    return variant + ", blocks of " + std::to_string(extraction.block) + ", " + name(extraction.platform);
}

inline Layers layers_of(const Mesh& mesh, const View& view, glm::ivec2 size,
                        const Extraction& extraction = {LayerVariant::blocked})
{
    const Scene scene(mesh);
    LayersSorter sorter(scene, extraction.variant, extraction.platform, size, extraction.block);
    Order order;
    sorter.sort(view, order);
    return sorter.layers();
}

inline void expect_same(const Layers& a, const Layers& b)
{
    EXPECT_EQ(a.count, b.count);
    EXPECT_EQ(a.layer, b.layer);
    EXPECT_EQ(a.cycles, b.cycles);
    ASSERT_EQ(a.unproven.size(), b.unproven.size());
    for (std::size_t i = 0; i < a.unproven.size(); ++i) {
        EXPECT_EQ(a.unproven[i].item, b.unproven[i].item);
        EXPECT_EQ(a.unproven[i].reason, b.unproven[i].reason);
    }
}

/// At every sample point, the nearer of two triangles has the lower layer, and none that covers a sample point lacks
/// one.
inline bench::LayerCheck expect_true(const Mesh& mesh, const View& view, glm::ivec2 size, const Layers& layers)
{
    bench::LayerCheck check = bench::check_layers(mesh, view, size, layers);
    EXPECT_EQ(check.wrong, 0u);
    EXPECT_EQ(check.missed, 0u);
    for (const std::string& witness : check.witnesses)
        ADD_FAILURE() << witness;
    return check;
}

inline std::size_t count_of(const Layers& layers, WithoutProof reason)
{
    std::size_t count = 0;
    for (const Layers::Unproven& unproven : layers.unproven)
        count += unproven.reason == reason ? 1 : 0;
    return count;
}

} // namespace visorder::tests
