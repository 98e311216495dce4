#include "depth/newell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <oneapi/tbb/parallel_sort.h>
#include <span>

// The cells moved to the head are a path: each is obscured by the one that was head before it. When the last of them
// has gone into the order, the search of the one before goes on from where it was, since what it does not obscure it
// will not. So the moves are the descents of a depth-first search, and the second moves, which find a cell on the path
// or one that leads back to it, are what Tarjan's algorithm (1972) finds cycles by: they never move anything twice, and
// what they join is a strongly connected component of the whole relation "obscures", no more and no less.
//
// Nothing moves in the lists themselves, so that they stay in the order of z, and a search may always end early.

namespace visorder {

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
    Search search{cell, 0, 0, 0, 0};
    if (!obstruction_.can_obstruct(cell))
        search.extent = static_cast<std::uint32_t>(extents_.of(cell).size());
    enter_window(search);
    searches_.push_back(search);
}

// Begins with the first window of the search's extent, if it has one.
void Newell::enter_window(Search& search)
{
    const auto extents = extents_.of(search.cell);
    if (search.extent == extents.size())
        return;
    const WindowLists::Range windows = lists_.windows_of(extents[search.extent]);
    search.column = windows.first_column;
    search.row = windows.first_row;
    search.position = first_left_[lists_.list_of(windows, search.column, search.row)];
}

// Goes on with the search up to a cell that is obscured and has not come to the head yet.
bool Newell::next_obscured(Search& search, CellId& obscured)
{
    const auto extents = extents_.of(search.cell);
    for (; search.extent < extents.size(); ++search.extent, enter_window(search)) {
        const Extent& front = extents[search.extent];
        const WindowLists::Range windows = lists_.windows_of(front);
        while (true) {
            const std::uint32_t number = lists_.list_of(windows, search.column, search.row);
            const std::span<const WindowLists::Listed> list = lists_.list(number);
            std::size_t& first_left = first_left_[number];
            while (first_left < list.size() && number_[list[first_left].cell] == in_order)
                ++first_left;
            search.position = std::max(search.position, first_left);
            while (pass_first_tests(search, front, windows, list)) {
                const CellId back = list[search.position].cell;
                ++search.position;
                if (!obscures(search.cell, back))
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
            search.position = 0;
        }
    }
    return false;
}

// Moves the search on to the next cell of a list that the tests 1 to 3 do not settle; returns false where there is
// none.
bool Newell::pass_first_tests(Search& search, const Extent& front, const WindowLists::Range& windows,
                              std::span<const WindowLists::Listed> list)
{
    // These tests settle nearly all pairs, in no order that a processor could foresee: so the only branches are those
    // hardly ever taken.
    const std::uint32_t* const number = number_.data();
    const std::uint32_t lowest = lowest_[search.cell];
    const WindowLists::Listed* const end = list.data() + list.size();
    const WindowLists::Listed* at = list.data() + search.position;
    const std::uint32_t column = search.column, row = search.row;
    const Extent extent = front;
    const std::uint32_t first_column = windows.first_column, first_row = windows.first_row;
    std::size_t across_here = 0, down_here = 0;
    bool found = false;
    for (; at != end; ++at) {
        // Of a cell that is in the order, or came to the head after one that is known to be reached, nothing is left to
        // learn; and two cells that meet in several windows are a pair in the first of these alone.
        const bool is_pair = (number[at->cell] < lowest) &
                             (column == std::max<std::uint32_t>(first_column, at->first_column)) &
                             (row == std::max<std::uint32_t>(first_row, at->first_row));
        if (at->far < extent.near) {
            count_[depth] += is_pair;
            at = end;
            break;
        }
        const bool is_across = (at->right < extent.left) | (extent.right < at->left);
        const bool is_down = (at->top < extent.bottom) | (extent.top < at->bottom);
        across_here += is_pair & is_across;
        down_here += is_pair & !is_across & is_down;
        if (is_pair & !is_across & !is_down) {
            found = true;
            break;
        }
    }
    search.position = static_cast<std::size_t>(at - list.data());
    count_[across] += across_here;
    count_[down] += down_here;
    return found;
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
        statistics.push_back({names[i], static_cast<double>(count_[i])});
    return statistics;
}

std::unique_ptr<Sorter> make_newell(const Scene& scene, const SorterOptions& options)
{
    return std::make_unique<Newell>(scene, options.newell_windows);
}

} // namespace visorder
