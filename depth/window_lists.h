#pragma once

#include "depth/image_extents.h"
#include "parallel/large_array.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace visorder::detail {

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
    /// Of the cells in a list, column by column: their extents, and the first window of the image plane each is in.
    struct List {
        const CellId* cell;
        const float *left, *right, *bottom, *top, *far;
        const std::uint16_t *first_column, *first_row;
        std::size_t size;
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
                if (is_left(listed_.cell[next]))
                    listed_.copy(next, end++);
            begin_[list + 1] = end;
        }
    }

    Range windows_of(const Extent& extent) const
    {
        return {extent.plane, window(extent.left), window(extent.right), window(extent.bottom), window(extent.top)};
    }

    std::uint32_t list_of(const Range& range, std::uint32_t column, std::uint32_t row) const
    {
        return (range.plane * side_ + row) * side_ + column;
    }
    List list(std::uint32_t number) const
    {
        const std::size_t begin = begin_[number];
        return {listed_.cell.data() + begin,         listed_.left.data() + begin,      listed_.right.data() + begin,
                listed_.bottom.data() + begin,       listed_.top.data() + begin,       listed_.far.data() + begin,
                listed_.first_column.data() + begin, listed_.first_row.data() + begin, begin_[number + 1] - begin};
    }
    std::uint32_t count() const { return static_cast<std::uint32_t>(begin_.size() - 1); }

    std::size_t bytes() const
    {
        return sorted_.capacity() * sizeof(void*) + listed_.bytes() + begin_.capacity() * sizeof(std::size_t);
    }

private:
    std::uint16_t window(float x) const
    {
        return static_cast<std::uint16_t>(
            std::min(static_cast<std::uint32_t>(x * static_cast<float>(side_)), side_ - 1));
    }
    void distribute(std::uint32_t planes);

    struct Columns {
        LargeArray<CellId> cell;
        LargeArray<float> left, right, bottom, top, far;
        LargeArray<std::uint16_t> first_column, first_row;

        void resize(std::size_t size);
        void set(std::size_t at, const Extent& extent, const Range& windows);
        void copy(std::size_t from, std::size_t to);
        std::size_t bytes() const
        {
            return cell.capacity() * (sizeof(CellId) + 5 * sizeof(float) + 2 * sizeof(std::uint16_t));
        }
    };

    std::uint32_t side_ = 1;
    std::vector<const Extent*> sorted_;
    Columns listed_;
    std::vector<std::size_t> begin_; // of each list in listed_, and their end
};

} // namespace visorder::detail
