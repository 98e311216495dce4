#include "depth/newell.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <oneapi/tbb/parallel_sort.h>
#include <span>

// The cells moved to the head are a path: each is occluded by the one that was head before it. When the last of them
// has gone into the order, the search of the one before goes on from where it was, since what it does not occlude it
// will not. So the moves are the descents of a depth-first search, and the second moves, which find a cell on the path
// or one that leads back to it, are what Tarjan's algorithm (1972) finds cycles by: they never move anything twice, and
// what they join is a strongly connected component of the whole relation "occludes", no more and no less.
//
// Nothing moves in the lists themselves, so that they stay in the order of z, and a search may always end early.

namespace visorder::detail {

namespace {

constexpr std::uint32_t unseen = 0;
constexpr std::uint32_t in_order = std::numeric_limits<std::uint32_t>::max();

// About two cells wide, for cells that fill space evenly.
std::uint32_t windows_across(CellId cells)
{
    return std::clamp(static_cast<std::uint32_t>(std::lround(std::cbrt(cells) / 2)), 1u, 64u);
}

} // namespace

Newell::Newell(const Scene& scene, bool windows) : scene_(scene), windows_(windows), obstruction_(scene) {}

Guarantee Newell::guarantee() const
{
    if (!obstruction_.planar_faces())
        return Guarantee::approximate;
    return scene_.overlapping_cells().empty() ? Guarantee::exact : Guarantee::approximate;
}

void Newell::sort(const View& view, Order& order)
{
    validate(view);
    const CellId cells = scene_.cell_count();
    obstruction_.look_from(view.eye);
    extents_.evaluate(scene_, view.eye);
    lists_.build(extents_, windows_ ? windows_across(cells) : 1,
                 [&](CellId cell) { return obstruction_.can_be_obstructed(cell); });
    by_farthest_.resize(cells);
    for (CellId cell = 0; cell < cells; ++cell)
        by_farthest_[cell] = cell;
    oneapi::tbb::parallel_sort(by_farthest_.begin(), by_farthest_.end(), [&](CellId a, CellId b) {
        const double at_a = extents_.farthest(a), at_b = extents_.farthest(b);
        return at_a != at_b ? at_a > at_b : a < b;
    });

    order.back_to_front.clear();
    order.back_to_front.reserve(cells);
    order.layer_begin.clear();
    order.cycles.clear();
    number_.assign(cells, unseen);
    lowest_.resize(cells);
    first_left_.assign(lists_.count(), 0);
    count_ = {};
    next_number_ = 0;
    gone_ = 0;
    std::size_t cells_listed = cells;
    for (CellId farthest : by_farthest_) {
        if (number_[farthest] != unseen)
            continue;
        // No search is on, so that places in the lists may change: cells in the order, which are only passed over, go.
        if (3 * gone_ > cells_listed) {
            lists_.keep([&](CellId cell) { return number_[cell] != in_order; });
            std::fill(first_left_.begin(), first_left_.end(), 0);
            cells_listed -= gone_;
            gone_ = 0;
        }
        head(farthest);
        while (!searches_.empty()) {
            CellId obscured;
            if (next_obscured(searches_.back(), obscured)) {
                ++count_[moves];
                head(obscured);
                continue;
            }
            const CellId done = searches_.back().cell;
            searches_.pop_back();
            if (!searches_.empty()) {
                std::uint32_t& lowest = lowest_[searches_.back().cell];
                lowest = std::min(lowest, lowest_[done]);
            }
            if (lowest_[done] == number_[done])
                list_component(done, order);
        }
    }
    std::sort(order.cycles.begin(), order.cycles.end());
}

void Newell::head(CellId cell)
{
    number_[cell] = lowest_[cell] = ++next_number_;
    open_.push_back(cell);
    Search search{cell, 0, 0, 0, 0, 0, 0};
    if (!obstruction_.can_obstruct(cell))
        search.extent = static_cast<std::uint32_t>(extents_.of(cell).size());
    enter_extent(search);
    searches_.push_back(search);
}

// Begins with the first window of the search's extent, if it has one.
void Newell::enter_extent(Search& search)
{
    const auto extents = extents_.of(search.cell);
    if (search.extent == extents.size())
        return;
    const WindowLists::Range windows = lists_.windows_of(extents[search.extent]);
    search.column = windows.first_column;
    search.row = windows.first_row;
    enter_window(search);
}

// Begins with the first cell that is left in the window's list. The list goes on in the order of far ends, so that test
// 1 tells at once where the search is to end.
void Newell::enter_window(Search& search)
{
    const Extent& front = extents_.of(search.cell)[search.extent];
    const std::uint32_t number = lists_.list_of(lists_.windows_of(front), search.column, search.row);
    const WindowLists::List list = lists_.list(number);
    std::size_t& first_left = first_left_[number];
    while (first_left < list.size && number_[list.cell[first_left]] == in_order)
        ++first_left;
    const float* const begin = list.far + first_left;
    const float* const end =
        std::partition_point(begin, list.far + list.size, [&](float far) { return far >= front.near; });
    search.next = first_left;
    search.end = static_cast<std::size_t>(end - list.far);
    search.waiting = 0;
    if (search.end < list.size)
        count_[depth] += number_[list.cell[search.end]] < lowest_[search.cell];
}

// Goes on with the search up to a cell that is occluded and has not come to the head yet.
bool Newell::next_obscured(Search& search, CellId& obscured)
{
    const auto extents = extents_.of(search.cell);
    for (; search.extent < extents.size(); ++search.extent, enter_extent(search)) {
        const Extent& front = extents[search.extent];
        const WindowLists::Range windows = lists_.windows_of(front);
        while (true) {
            const WindowLists::List list = lists_.list(lists_.list_of(windows, search.column, search.row));
            while (search.waiting != 0 || search.next < search.end) {
                if (search.waiting == 0) {
                    first_tests(search, front, list);
                    continue;
                }
                const auto first = static_cast<std::size_t>(std::countr_zero(search.waiting));
                search.waiting &= search.waiting - 1;
                const CellId back = list.cell[search.next - block + first];
                if (number_[back] >= lowest_[search.cell] || !obscures(search.cell, back))
                    continue;
                if (number_[back] == unseen) {
                    obscured = back;
                    return true;
                }
                ++count_[second_moves];
                lowest_[search.cell] = number_[back];
            }
            if (search.column < windows.last_column) {
                ++search.column;
            } else if (search.row < windows.last_row) {
                search.column = windows.first_column;
                ++search.row;
            } else {
                break;
            }
            enter_window(search);
        }
    }
    return false;
}

// Holds a block of a list against the tests 2 and 3, which settle nearly all pairs, in no order that a processor could
// foresee: so without branches, and many at a time.
void Newell::first_tests(Search& search, const Extent& front, const WindowLists::List& list)
{
    const std::size_t begin = search.next, n = std::min(block, search.end - begin);
    // Of a cell that is in the order, or came to the head after one that is known to be reached, nothing is left to
    // learn; and two cells that meet in several windows are a pair in the first of these alone.
    std::array<std::uint32_t, block> pair, apart_across, apart_down;
    const std::uint32_t lowest = lowest_[search.cell];
    for (std::size_t i = 0; i < n; ++i)
        pair[i] = number_[list.cell[begin + i]] < lowest;
    if (windows_) {
        const WindowLists::Range windows = lists_.windows_of(front);
        for (std::size_t i = 0; i < n; ++i)
            pair[i] &= static_cast<std::uint32_t>(
                (search.column == std::max(windows.first_column, list.first_column[begin + i])) &
                (search.row == std::max(windows.first_row, list.first_row[begin + i])));
    }
    const float left = front.left, right = front.right, bottom = front.bottom, top = front.top;
    for (std::size_t i = 0; i < n; ++i)
        apart_across[i] = static_cast<std::uint32_t>((list.right[begin + i] < left) | (right < list.left[begin + i]));
    for (std::size_t i = 0; i < n; ++i)
        apart_down[i] = static_cast<std::uint32_t>((list.top[begin + i] < bottom) | (top < list.bottom[begin + i]));
    std::uint32_t settled_across = 0, settled_down = 0, left_over = 0;
    for (std::size_t i = 0; i < n; ++i) {
        settled_across += pair[i] & apart_across[i];
        pair[i] &= ~apart_across[i];
        settled_down += pair[i] & apart_down[i];
        pair[i] &= ~apart_down[i];
        left_over |= pair[i];
    }
    count_[across] += settled_across;
    count_[down] += settled_down;
    search.next = begin + block;
    for (std::size_t i = 0; left_over != 0 && i < n; ++i)
        search.waiting |= pair[i] << i;
}

// The tests after the first three.
bool Newell::obscures(CellId front, CellId back)
{
    if (extents_.cones_apart(front, back)) {
        ++count_[cones];
        return false;
    }
    if (extents_.sphere_behind(front, back)) {
        ++count_[spheres];
        return false;
    }
    switch (obstruction_.test(front, back)) {
    case Settled::by_front_plane:
        ++count_[front_planes];
        return false;
    case Settled::by_back_plane:
        ++count_[back_planes];
        return false;
    case Settled::apart:
        ++count_[definitive_apart];
        return false;
    case Settled::obstructs:
        break;
    }
    ++count_[definitive_obstructs];
    return true;
}

// Of the cells of a cycle, too, the farthest comes first.
void Newell::list_component(CellId first, Order& order)
{
    const auto begin = std::find(open_.rbegin(), open_.rend(), first).base() - 1;
    const auto caller = scene_.caller_cells();
    std::sort(begin, open_.end(), [&](CellId a, CellId b) {
        const double at_a = extents_.farthest(a), at_b = extents_.farthest(b);
        return at_a != at_b ? at_a > at_b : a < b;
    });
    const std::span<const CellId> cells(begin, open_.end());
    for (CellId cell : cells) {
        number_[cell] = in_order;
        ++gone_;
        order.back_to_front.push_back(caller[cell]);
    }
    if (cells.size() > 1) {
        std::vector<CellId>& cycle = order.cycles.emplace_back();
        for (CellId cell : cells)
            cycle.push_back(caller[cell]);
        std::sort(cycle.begin(), cycle.end());
    }
    open_.erase(begin, open_.end());
}

std::size_t Newell::bytes() const
{
    return obstruction_.bytes() + extents_.bytes() + lists_.bytes() + by_farthest_.capacity() * sizeof(CellId) +
           (number_.capacity() + lowest_.capacity()) * sizeof(std::uint32_t) + searches_.capacity() * sizeof(Search) +
           open_.capacity() * sizeof(CellId) + first_left_.capacity() * sizeof(std::size_t);
}

std::vector<Statistic> Newell::statistics() const
{
    constexpr std::array<const char*, counts> names{"settled by test 1 (z)",
                                                    "settled by test 2 (x)",
                                                    "settled by test 3 (y)",
                                                    "settled by test 1' (cones)",
                                                    "settled by test 2' (spheres)",
                                                    "settled by test 4 (planes of the front cell)",
                                                    "settled by test 5 (planes of the back cell)",
                                                    "settled by the definitive test: apart",
                                                    "settled by the definitive test: obscured",
                                                    "moves",
                                                    "second moves"};
    std::size_t pairs = 0;
    for (std::size_t i = depth; i <= definitive_obstructs; ++i)
        pairs += count_[i];
    std::vector<Statistic> statistics{{"pairs", static_cast<double>(pairs)}};
    for (std::size_t i = 0; i < counts; ++i)
        statistics.push_back(
            {names[i], static_cast<double>(count_[i]), static_cast<double>(i <= definitive_obstructs ? pairs : 0)});
    return statistics;
}

} // namespace visorder::detail
