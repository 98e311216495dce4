#pragma once

#include "depth/image_extents.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace visorder {

/// Lists of cells by the z of their farthest vertex, farthest first: one for each of several windows that divide each
/// image plane, of the cells whose extents meet it (Max, Williams and Silva 2000, section III, after Williams, Max and
/// Stein 1998). With one window an image plane, the lists of Newell's algorithm.
///
/// `build` is one call at a time; between two of them any number of threads may ask.
class WindowLists {
public:
    /// The windows that an extent meets: columns and rows of one image plane.
    struct Range {
        std::uint32_t plane;
        std::uint16_t first_column, last_column, first_row, last_row;
    };
    /// A cell in a list: its extent, and the first window of the image plane that it is in.
    struct Listed {
        CellId cell;
        std::uint16_t first_column, first_row;
        float left, right, bottom, top, far;
    };

    /// Lists those of `extents` whose cell `is_listed`, in `side` by `side` windows an image plane.
    template <class IsListed>
    void build(const ImageExtents& extents, std::uint32_t side, IsListed&& is_listed)
    {
        side_ = side;
        sorted_.clear();
        for (const Extent& extent : extents.all())
            if (is_listed(extent.cell))
                sorted_.push_back(&extent);
        distribute(extents.plane_count());
    }

    /// Takes cells out of the lists.
    template <class IsLeft>
    void keep(IsLeft&& is_left)
    {
        std::size_t end = 0, next = 0;
        for (std::size_t list = 0; list < count(); ++list) {
            const std::size_t list_end = begin_[list + 1];
            for (; next < list_end; ++next)
                if (is_left(listed_[next].cell))
                    listed_[end++] = listed_[next];
            begin_[list + 1] = end;
        }
        listed_.resize(end);
    }

    Range windows_of(const Extent& extent) const
    {
        return {extent.plane, window(extent.left), window(extent.right), window(extent.bottom), window(extent.top)};
    }

    std::uint32_t list_of(const Range& range, std::uint32_t column, std::uint32_t row) const
    {
        return (range.plane * side_ + row) * side_ + column;
    }
    std::span<const Listed> list(std::uint32_t number) const
    {
        return {listed_.data() + begin_[number], listed_.data() + begin_[number + 1]};
    }
    std::uint32_t count() const { return static_cast<std::uint32_t>(begin_.size() - 1); }

    std::size_t bytes() const
    {
        return sorted_.capacity() * sizeof(const Extent*) + listed_.capacity() * sizeof(Listed) +
               begin_.capacity() * sizeof(std::size_t);
    }

private:
    std::uint16_t window(float x) const
    {
        return static_cast<std::uint16_t>(
            std::min(static_cast<std::uint32_t>(x * static_cast<float>(side_)), side_ - 1));
    }
    void distribute(std::uint32_t planes);

    std::uint32_t side_ = 1;
    std::vector<const Extent*> sorted_;
    std::vector<Listed> listed_;
    std::vector<std::size_t> begin_; // of each list in listed_, and their end
};

} // namespace visorder
