#include "depth/window_lists.h"

#include "parallel/large_array.h"

#include <oneapi/tbb/parallel_sort.h>

namespace visorder::detail {

void WindowLists::Columns::resize(std::size_t size)
{
    cell.resize(size);
    for (LargeArray<float>* column : {&left, &right, &bottom, &top, &far})
        column->resize(size);
    first_column.resize(size);
    first_row.resize(size);
}

void WindowLists::Columns::set(std::size_t at, const Extent& extent, const Range& windows)
{
    cell[at] = extent.cell;
    left[at] = extent.left;
    right[at] = extent.right;
    bottom[at] = extent.bottom;
    top[at] = extent.top;
    far[at] = extent.far;
    first_column[at] = windows.first_column;
    first_row[at] = windows.first_row;
}

void WindowLists::Columns::copy(std::size_t from, std::size_t to)
{
    cell[to] = cell[from];
    for (LargeArray<float>* column : {&left, &right, &bottom, &top, &far})
        (*column)[to] = (*column)[from];
    first_column[to] = first_column[from];
    first_row[to] = first_row[from];
}

void WindowLists::distribute(std::uint32_t planes)
{
    oneapi::tbb::parallel_sort(sorted_.begin(), sorted_.end(), [](const Extent* a, const Extent* b) {
        return a->far != b->far ? a->far > b->far : a->cell < b->cell;
    });
    const auto each = [&](auto&& visit) {
        for (const Extent* extent : sorted_) {
            const Range range = windows_of(*extent);
            for (std::uint32_t row = range.first_row; row <= range.last_row; ++row)
                for (std::uint32_t column = range.first_column; column <= range.last_column; ++column)
                    visit(*extent, range, list_of(range, column, row));
        }
    };
    begin_.assign(std::size_t{planes} * side_ * side_ + 2, 0);
    each([&](const Extent&, const Range&, std::uint32_t list) { ++begin_[list + 2]; });
    for (std::size_t list = 2; list < begin_.size(); ++list)
        begin_[list] += begin_[list - 1];
    listed_.resize(begin_.back());
    // Each list's beginning moves on to its end, which is the beginning of the next.
    each([&](const Extent& extent, const Range& range, std::uint32_t list) {
        listed_.set(begin_[list + 1]++, extent, range);
    });
    begin_.pop_back();
}

} // namespace visorder::detail
