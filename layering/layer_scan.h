#pragma once

#include "layering/item_buffer.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace visorder::detail {

/// What a frame took, as in the paper's Fig. 2. Flags are words of 32 bits, read instead of pixels by the scan on the
/// renderer.
struct LayerWork {
    double rendering_s = 0;
    double reading_s = 0;
    double scanning_s = 0; ///< of images
    double rest_s = 0;     ///< projecting, and taking apart what is left with a cycle in it
    std::size_t passes = 0;
    std::size_t pixels_read = 0; ///< values of one buffer: an item, or a count of the stencil buffer
    std::size_t flags_read = 0;
    std::size_t fragments_read = 0; ///< of what was left with a cycle in it

    double total_s() const { return rendering_s + reading_s + scanning_s + rest_s; }
};

/// Reading and scanning (Krishnan, Silva, Wei 2002, section 3): what is found in the images that an ItemBuffer draws.
/// One frame at a time; the context must be current. All implementations find the same.
class LayerScan {
public:
    virtual ~LayerScan() = default;

    /// A new frame, whose work goes to `work`.
    virtual void begin(const ItemBuffer& items, LayerWork& work) = 0;

    /// Step 3: puts the items of the nearest image into `candidates`, ascending.
    virtual void find_candidates(std::vector<std::uint32_t>& candidates) = 0;

    /// What a pass of step 4 left to do.
    struct Outcome {
        bool again = false;     ///< some pixel may show another covered item when those found are taken off
        bool saturated = false; ///< some pixel has as many items as the stencil buffer can count, or more
    };

    /// Step 4c: appends to `covered` the items that the farthest image shows where the nearest one shows another.
    /// `remaining`, of which that image was drawn, are the candidates without those found before. Only blocks where
    /// the last pass was not the last are looked at.
    ///
    /// The paper compares with nothing: it takes off what it finds where the stencil buffer counts more than one, and
    /// forgets that an item just taken off still covers what lies behind it.
    virtual Outcome find_covered(std::span<const std::uint32_t> remaining, std::vector<std::uint32_t>& covered) = 0;

    /// Where there can be anything: what the last nearest image did not cover, none will.
    virtual PixelRectangle alive() const = 0;

    virtual std::size_t bytes() const = 0;
};

/// Reads the images back, block by block of `block` x `block` pixels, or whole where `block` is 0. A block is not read
/// again once it was empty, nor by step 4 once none of its pixels has several items.
std::unique_ptr<LayerScan> make_readback_scan(int block);

/// Scans by compute shaders. One flag an item is read back.
std::unique_ptr<LayerScan> make_compute_scan(const Context& context);

} // namespace visorder::detail
