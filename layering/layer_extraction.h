#pragma once

#include "layering/item_buffer.h"
#include "layering/layer_scan.h"
#include "layering/pixel_sequences.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace visorder::detail {

/// Why an item has no proof of its place.
enum class WithoutProof : std::uint8_t {
    no_sample, ///< it covers no sample point at this resolution: too small, beside the image, or behind the eye
    edge_on,   ///< the eye lies in its plane
    cycle      ///< each of a set is somewhere in front of another of it, at this resolution; items that cross are such
};

const char* name(WithoutProof reason);

/// The layers of an image.
struct Layers {
    std::uint32_t count = 0;
    /// Of each item: 1 is the nearest; 0 where there is none. Of the items that cover a sample point, the nearer one
    /// has the lower number, unless both are of one cycle. An item's layer is 1 more than the highest of those that
    /// cover a part of it (the members of a cycle have one layer between them).
    std::vector<std::uint32_t> layer;
    std::vector<std::vector<std::uint32_t>> cycles; ///< items, each and all of them ascending
    struct Unproven {
        std::uint32_t item;
        WithoutProof reason;
    };
    std::vector<Unproven> unproven; ///< ascending by item
};

/// How to find what the images show.
enum class LayerVariant {
    naive,   ///< reads whole images
    blocked, ///< reads blocks of them, and none again that was empty
    compute  ///< has the renderer scan them, and reads one flag an item
};

/// Layer extraction by the z-, the stencil and the colour buffer (Krishnan, Silva, Wei 2002, section 3):
///
/// 1. Of all items T that have no layer yet, draw the nearest image: the z-test lets pass what is nearer (step 1, 2).
/// 2. The items it shows are candidates, F (step 3). Any other item of T lies behind one of them.
/// 3. Draw the farthest image of F, and count in the stencil buffer how many items cover each pixel (step 4a, b). Take
///    off what it shows behind another item; repeat while items lie behind each other (step 4c). After many passes, or
///    where the stencil buffer cannot count so far, one pass in which the items mark themselves finds the others.
/// 4. What is left of F is covered nowhere: it is the next layer (step 4d).
/// 5. Where nothing is left, T contains a cycle (step 5).
///
/// Two things are added. An item is taken off wherever it is not what the nearest image shows, because the one in front
/// of it may itself have been taken off before. And the extraction does not end at a cycle: what is left of T is then
/// taken apart pixel by pixel (PixelSequences), so that only the items in cycles are left without proof, not all that
/// lies behind them. So is what lies behind the 255th layer, where drawing all of T for each would take long.
///
/// An item counts as covering a pixel if the pixel's centre lies strictly inside it; of several at one depth, as 32-bit
/// numbers have it, the one with the lower number is the nearer. So the layers depend neither on the variant nor on how
/// a renderer fills triangles.
///
/// Keeps its memory from frame to frame. The context must be current where it is made and used.
class LayerExtraction {
public:
    /// `block` is that of the blocked variant, in pixels. Throws InputError if it is not positive.
    LayerExtraction(const Context& context, LayerVariant variant, int block);

    /// Extracts the layers of the `drawn` items (a flag each); the others are edge-on. Throws InputError for a size
    /// that cannot be drawn.
    void run(const ItemMesh& items, std::span<const std::uint8_t> drawn, std::span<const glm::dvec3> points,
             const glm::dmat4& world_to_clip, glm::ivec2 size, Layers& layers);

    /// Of the last run.
    const LayerWork& work() const { return work_; }

    std::size_t bytes() const;

private:
    bool extract_layer(Layers& layers);
    bool take_apart(Layers& layers);

    const Context* context_;
    ItemBuffer buffer_;
    std::unique_ptr<LayerScan> scan_;
    PixelSequences sequences_;
    ImageTriangles triangles_;
    LayerWork work_;
    std::vector<std::uint32_t> rest_; // T; ascending, as are the others
    std::vector<std::uint32_t> candidates_;
    std::vector<std::uint32_t> covered_;
    std::vector<std::uint32_t> kept_;
};

} // namespace visorder::detail
