#include "depth/window_lists.h"

#include <oneapi/tbb/parallel_sort.h>

namespace visorder {

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
    each([&](const Extent& e, const Range& range, std::uint32_t list) {
        listed_[begin_[list + 1]++] = {e.cell,  range.first_column, range.first_row, e.left,
                                       e.right, e.bottom,           e.top,           e.far};
    });
    begin_.pop_back();
}

} // namespace visorder
