#pragma once

#include "layering/item_buffer.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace visorder::detail {

/// What covers one pixel at one depth.
struct Fragment {
    std::uint32_t pixel; ///< y * width + x
    float depth;         ///< 1 at the nearest point, 0 at the farthest
    std::uint32_t item;
};

/// All items that cover each pixel, nearest first: the layers of the image pixel by pixel, in one pass. Every fragment
/// is appended to a list, which is read back and sorted by pixel. Where a list would be too long, the image is taken in
/// parts. Of several items at one depth the one with the lower number comes first.
///
/// The context of the item buffer must be current.
class PixelSequences {
public:
    /// Lists of up to `capacity` fragments, 12 bytes each.
    explicit PixelSequences(ItemBuffer& items, std::uint32_t capacity = 1 << 22);

    /// Calls `visit` for every pixel in `within` that any of the items covers. `items` ascend. Throws GraphicsError
    /// where one pixel alone has more fragments than a list holds.
    void visit(std::span<const std::uint32_t> items, const PixelRectangle& within,
               const std::function<void(std::span<const Fragment>)>& visit);

    // Of the last `visit`.
    double rendering_s() const { return rendering_s_; }
    double reading_s() const { return reading_s_; }
    int passes() const { return passes_; }
    std::size_t fragment_count() const { return fragment_count_; }

    std::size_t bytes() const;

private:
    void visit_part(std::span<const std::uint32_t> items, const PixelRectangle& within,
                    const std::function<void(std::span<const Fragment>)>& visit);
    void sort_by_pixel(const PixelRectangle& within);

    ItemBuffer& items_;
    std::uint32_t capacity_;
    Program append_;
    GlObject list_;
    std::vector<Fragment> fragments_;
    std::vector<Fragment> sorted_;
    std::vector<std::uint32_t> begin_; // of each pixel of a part in sorted_
    double rendering_s_ = 0;
    double reading_s_ = 0;
    int passes_ = 0;
    std::size_t fragment_count_ = 0;
};

} // namespace visorder::detail
