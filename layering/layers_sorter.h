#pragma once

#include "layering/layer_extraction.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"

#include <memory>
#include <vector>

namespace visorder::detail {

/// The layers of a surface scene's triangles as a sorter (Krishnan, Silva, Wei 2002): the farthest layer first. Looks
/// through `world_to_clip`, at one sample point a pixel, and is right at these points; what happens between them it
/// does not see. What covers none of them comes first of all, as a layer of its own. In a layer, triangles ascend, but
/// for those in cycles, which follow set by set, farthest centre first.
///
/// Holds an OpenGL context. One `sort` at a time on one sorter, on any thread.
class LayersSorter final : public Sorter {
public:
    /// Of images of `size` pixels, or of the view's size where that is 0. Throws InputError for a scene of solids, and
    /// GraphicsError where there is no OpenGL.
    LayersSorter(const Scene& scene, LayerVariant variant, GlPlatform platform, glm::ivec2 size, int block);

    Guarantee guarantee() const override { return Guarantee::approximate; }
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override;
    std::vector<Statistic> statistics() const override;

    /// Of the last `sort`; items are the caller's cells.
    const Layers& layers() const { return layers_; }
    const LayerWork& work() const { return extraction_->work(); }
    const Context& context() const { return context_; }

private:
    void write(const View& view, Order& order) const;

    Scene scene_;
    ItemMesh items_;
    glm::ivec2 size_;
    Context context_;
    std::unique_ptr<LayerExtraction> extraction_;
    std::vector<std::uint8_t> drawn_;
    Layers layers_;
};

} // namespace visorder::detail
