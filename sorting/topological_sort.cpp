#include "sorting/topological_sort.h"

#include "parallel/concurrency.h"
#include "parallel/team.h"
#include "scene/face_set.h"
#include "sorting/cyclic_order.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <limits>
#include <numeric>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace visorder::detail {

namespace {

constexpr CellId worth_a_team = 1 << 15; // cells; fewer are sorted by one thread
constexpr int owner_block_bits = 15;     // runs of 2^15 cells along the curve have one owner
constexpr std::size_t step = 1 << 14;    // cells between two looks at the room in the lists
constexpr std::size_t most_members = 16; // in a team
constexpr std::size_t prefetch_rows = 32;
constexpr std::size_t prefetch_states = 12;

using Front = TopologicalSort::Front;

// What one frame works on. A cell's state holds, in the lowest `row` bits, the faces across which lie cells that it
// occludes no more once listed (its entry faces: what is across them comes later), and above them how many cells that
// it occludes are not listed yet. At zero it is ready.
template <int row, class State>
struct Frame {
    static constexpr State one = State{1} << row;

    const CellId* neighbour;
    State* state;
    std::uint32_t* level;
    CellId cells;
    const std::uint32_t* more_begin; // null if there are no more relations
    const CellId* more_front;

    static bool ready(State s) { return s < one; }
};

struct alignas(64) Published {
    std::array<std::atomic<std::size_t>, 2> pending{}; // by parity of the level
};

// One thread's part in the levels: it owns every size-th block of cells, and alone writes their states. What it would
// change of another's cell it leaves in that one's box, to be read in the next level.
template <int row, class State, bool shared>
class Member {
public:
    Member(const Frame<row, State>& frame, std::vector<Front>& fronts, std::size_t member, std::size_t size)
        : frame_(frame), fronts_(fronts), front_(fronts[member]), me_(member), owners_(size - 1)
    {
        front_.level_counts.clear();
        ready_ = 0;
        for (auto& boxes : front_.out) {
            boxes.resize(size);
            for (auto& box : boxes)
                box.clear();
        }
    }

    void find_first_level()
    {
        for (CellId begin = 0; begin < frame_.cells; begin += 1u << owner_block_bits) {
            if (shared && owner(begin) != me_)
                continue;
            const CellId end = std::min<CellId>(frame_.cells, begin + (1u << owner_block_bits));
            make_room(front_.now, ready_, end - begin);
            for (CellId cell = begin; cell < end; ++cell) {
                if (cell + 8 <= end && none_of_eight_ready(frame_.state + cell)) {
                    cell += 7;
                    continue;
                }
                front_.now[ready_] = cell;
                ready_ += Frame<row, State>::ready(frame_.state[cell]);
            }
        }
    }

    // Lists the cells that are ready at `level`, and returns how many entries it leaves for the next one.
    std::size_t do_level(std::uint32_t level)
    {
        if constexpr (shared)
            read_boxes(level);
        front_.level_counts.push_back(static_cast<std::uint32_t>(ready_));
        next_ = 0;
        if constexpr (shared)
            sent_.assign(fronts_.size(), 0);
        for (std::size_t begin = 0; begin < ready_; begin += step) {
            const std::size_t end = std::min(begin + step, ready_);
            make_room(front_.next, next_, (end - begin) * row + 1);
            if constexpr (shared)
                for (std::size_t to = 0; to < fronts_.size(); ++to)
                    make_room(front_.out[level & 1][to], sent_[to], (end - begin) * row + 1);
            if (frame_.more_begin != nullptr)
                list<true>(begin, end, level);
            else
                list<false>(begin, end, level);
        }
        std::size_t pending = next_;
        if constexpr (shared)
            for (std::size_t to = 0; to < fronts_.size(); ++to) {
                front_.out[level & 1][to].resize(sent_[to]);
                pending += sent_[to];
            }
        std::swap(front_.now, front_.next);
        ready_ = next_;
        return pending;
    }

    std::size_t ready() const { return ready_; }

private:
    void read_boxes(std::uint32_t level)
    {
        for (std::size_t from = 0; from < fronts_.size(); ++from) {
            if (from == me_)
                continue;
            LargeArray<CellId>& box = fronts_[from].out[~level & 1][me_];
            make_room(front_.now, ready_, box.size());
            for (std::size_t i = 0; i < box.size(); ++i) {
                const CellId cell = box[i];
                const State s = static_cast<State>(frame_.state[cell] - Frame<row, State>::one);
                frame_.state[cell] = s;
                front_.now[ready_] = cell;
                ready_ += Frame<row, State>::ready(s);
            }
        }
    }

    // Almost no cell is ready at first: states of one byte are passed over eight at a time.
    static bool none_of_eight_ready(const State* states)
    {
        if constexpr (sizeof(State) > 1)
            return false;
        std::uint64_t eight;
        std::memcpy(&eight, states, sizeof eight);
        // The counts, four bits each: none is zero if adding 15 to every one carries out of all of them.
        const std::uint64_t counts = eight >> row & 0x0f0f0f0f0f0f0f0fu;
        return ((counts + 0x0f0f0f0f0f0f0f0fu) & 0x1010101010101010u) == 0x1010101010101010u;
    }

    static void make_room(LargeArray<CellId>& list, std::size_t used, std::size_t more)
    {
        if (list.size() < used + more)
            list.resize(std::max(used + more, list.size() + list.size() / 2));
    }

    std::size_t owner(CellId cell) const { return (cell >> owner_block_bits) & owners_; }

    // Lists now[begin, end) of this level. Everything the loop touches is held in local variables: a state may be a
    // byte, and the compiler takes a store of a byte to change anything that is not local.
    template <bool more>
    void list(std::size_t begin, std::size_t end, std::uint32_t level)
    {
        const CellId* const now = front_.now.data();
        const CellId* const neighbour = frame_.neighbour;
        State* const state = frame_.state;
        std::uint32_t* const level_of = frame_.level;
        const std::size_t me = me_, owners = owners_;
        CellId* next = front_.next.data();
        std::size_t next_count = next_;
        std::array<CellId*, most_members> box;
        std::array<std::size_t, most_members> sent;
        const auto hold_boxes = [&] {
            for (std::size_t to = 0; shared && to < fronts_.size(); ++to)
                box[to] = front_.out[level & 1][to].data();
        };
        hold_boxes();
        if constexpr (shared)
            std::copy_n(sent_.begin(), fronts_.size(), sent.begin());

        // One relation less between the cell being listed and what comes after it (`front`), if `holds`.
        // Without branches on the relation: which way a face looks is as good as random.
        const auto satisfy = [&](CellId front, State holds) {
            if constexpr (shared) {
                // Blocks are so large that this branch is nearly always right.
                const std::size_t to = (front >> owner_block_bits) & owners;
                if (to != me) {
                    box[to][sent[to]] = front;
                    sent[to] += holds;
                    return;
                }
            }
            const auto s = static_cast<State>(state[front] - (holds << row));
            state[front] = s;
            next[next_count] = front;
            next_count += holds & static_cast<State>(Frame<row, State>::ready(s));
        };
        for (std::size_t i = begin; i < end; ++i) {
            if (i + prefetch_rows < end) {
                const CellId ahead = now[i + prefetch_rows];
                __builtin_prefetch(neighbour + std::size_t{ahead} * row);
                __builtin_prefetch(level_of + ahead, 1);
                const CellId* soon = neighbour + std::size_t{now[i + prefetch_states]} * row;
                // Another's states stay where they are: to read a line is to take it from its owner.
                for (int f = 0; f < row; ++f)
                    __builtin_prefetch(
                        state + (shared && ((soon[f] >> owner_block_bits) & owners) != me ? ahead : soon[f]), 1);
            }
            const CellId cell = now[i];
            const State entry = state[cell];
            level_of[cell] = level;
            const CellId* across = neighbour + std::size_t{cell} * row;
            for (int f = 0; f < row; ++f)
                satisfy(across[f], static_cast<State>(entry >> f & 1u));
            if constexpr (more)
                for (std::uint32_t k = frame_.more_begin[cell]; k < frame_.more_begin[cell + 1]; ++k) {
                    make_room(front_.next, next_count, std::size_t{row} * step + 2);
                    next = front_.next.data();
                    for (std::size_t to = 0; shared && to < fronts_.size(); ++to)
                        make_room(front_.out[level & 1][to], sent[to], std::size_t{row} * step + 2);
                    hold_boxes();
                    satisfy(frame_.more_front[k], State{1});
                }
        }
        next_ = next_count;
        if constexpr (shared)
            std::copy_n(sent.begin(), fronts_.size(), sent_.begin());
    }

    const Frame<row, State>& frame_;
    std::vector<Front>& fronts_;
    Front& front_;
    std::size_t me_;
    std::size_t owners_;
    std::size_t ready_ = 0;
    std::size_t next_ = 0;
    std::vector<std::size_t> sent_;
};

template <int row, class State>
void list_alone(const Frame<row, State>& frame, std::vector<Front>& fronts)
{
    Member<row, State, false> member(frame, fronts, 0, 1);
    member.find_first_level();
    for (std::uint32_t level = 0; member.ready() > 0; ++level)
        member.do_level(level);
}

template <int row, class State>
void list_together(const Frame<row, State>& frame, std::vector<Front>& fronts, std::vector<Published>& published,
                   Team& team, std::size_t me)
{
    Member<row, State, true> member(frame, fronts, me, team.size());
    // Boxes are read by others from here on.
    team.wait_for_all();
    member.find_first_level();
    for (std::uint32_t level = 0;; ++level) {
        const std::size_t pending = member.do_level(level);
        published[me].pending[level & 1].store(pending, std::memory_order_relaxed);
        team.wait_for_all();
        std::size_t all = 0;
        for (const Published& p : published)
            all += p.pending[level & 1].load(std::memory_order_relaxed);
        if (all == 0)
            return;
    }
}

// States of all cells from the sides of their faces.
template <int row, class State>
void count_relations(const Adjacency& adjacency, const FaceSigns& signs, State* state, CellId cells)
{
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, cells, 16384), [&](const auto& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell) {
            const std::uint32_t interior = adjacency.interior[cell];
            const std::uint32_t obstructed = bits_set[signs.exit(cell) & interior];
            state[cell] = static_cast<State>((signs.entry(cell) & interior) | obstructed << row);
        }
    });
}

// The cells that are left when no more are ready: those in cycles and behind them. Gives them levels after the others'
// and reports the cycles.
template <int row, class State>
void list_cycles(const Frame<row, State>& frame, std::span<const CellId> caller_cells,
                 std::span<const Relation> tentative, std::vector<std::uint32_t>& level_counts,
                 std::vector<std::vector<CellId>>& cycles)
{
    std::vector<CellId> left;
    for (CellId cell = 0; cell < frame.cells; ++cell)
        if (!Frame<row, State>::ready(frame.state[cell]))
            left.push_back(cell);
    std::vector<Relation> given_up_first(tentative.begin(), tentative.end());
    std::sort(given_up_first.begin(), given_up_first.end());

    std::vector<Precedence> edges;
    const auto add = [&](std::uint32_t back, CellId front) {
        const auto at = std::lower_bound(left.begin(), left.end(), front) - left.begin();
        edges.push_back(
            {back, static_cast<std::uint32_t>(at),
             std::binary_search(given_up_first.begin(), given_up_first.end(), Relation{front, left[back]})});
    };
    for (std::uint32_t i = 0; i < left.size(); ++i) {
        const CellId cell = left[i];
        for (int f = 0; f < row; ++f)
            if ((frame.state[cell] >> f & 1u) != 0)
                add(i, frame.neighbour[std::size_t{cell} * row + static_cast<std::size_t>(f)]);
        if (frame.more_begin != nullptr)
            for (std::uint32_t k = frame.more_begin[cell]; k < frame.more_begin[cell + 1]; ++k)
                add(i, frame.more_front[k]);
    }

    const CyclicOrder ordered = order_with_cycles(static_cast<std::uint32_t>(left.size()), edges);
    const auto first_level = static_cast<std::uint32_t>(level_counts.size());
    level_counts.resize(first_level + ordered.level_count, 0);
    for (std::uint32_t i = 0; i < left.size(); ++i) {
        frame.level[left[i]] = first_level + ordered.level[i];
        ++level_counts[first_level + ordered.level[i]];
    }
    for (const std::vector<std::uint32_t>& nodes : ordered.cycles) {
        std::vector<CellId>& cycle = cycles.emplace_back();
        for (const std::uint32_t i : nodes)
            cycle.push_back(caller_cells[left[i]]);
        std::sort(cycle.begin(), cycle.end());
    }
    std::sort(cycles.begin(), cycles.end());
}

// Lists cells by level, those of one level in inner order: a counting sort, in chunks of cells side by side.
void write_order(std::span<const std::uint32_t> level, std::span<const CellId> caller_cells,
                 std::vector<std::uint32_t>& cursors, Order& order)
{
    const std::size_t cells = level.size(), levels = order.layer_begin.size();
    const std::size_t chunks = std::clamp<std::size_t>(cells / worth_a_team, 1, concurrency());
    const auto begin_of = [&](std::size_t chunk) { return cells * chunk / chunks; };
    const auto each_chunk = [&](auto&& body) {
        oneapi::tbb::parallel_for(std::size_t{0}, chunks, body, oneapi::tbb::simple_partitioner());
    };
    cursors.resize(chunks * levels);
    if (chunks == 1) {
        std::copy(order.layer_begin.begin(), order.layer_begin.end(), cursors.begin());
    } else {
        each_chunk([&](std::size_t chunk) {
            std::uint32_t* count = cursors.data() + chunk * levels;
            std::fill_n(count, levels, 0u);
            for (std::size_t i = begin_of(chunk); i < begin_of(chunk + 1); ++i)
                ++count[level[i]];
        });
        for (std::size_t l = 0; l < levels; ++l) {
            std::uint32_t at = order.layer_begin[l];
            for (std::size_t chunk = 0; chunk < chunks; ++chunk)
                at += std::exchange(cursors[chunk * levels + l], at);
        }
    }
    each_chunk([&](std::size_t chunk) {
        std::uint32_t* cursor = cursors.data() + chunk * levels;
        CellId* to = order.back_to_front.data();
        for (std::size_t i = begin_of(chunk); i < begin_of(chunk + 1); ++i)
            to[cursor[level[i]]++] = caller_cells[i];
    });
}

void group_by_back(std::span<const Relation> more, std::span<const Relation> tentative, CellId cells,
                   std::vector<std::uint32_t>& begin, std::vector<CellId>& fronts)
{
    begin.assign(std::size_t{cells} + 1, 0);
    fronts.resize(more.size() + tentative.size());
    for (const auto& relations : {more, tentative})
        for (const Relation& r : relations)
            ++begin[r.back];
    std::uint32_t end = 0;
    for (std::uint32_t& count : begin)
        count = end += count;
    for (const auto& relations : {tentative, more})
        for (std::size_t i = relations.size(); i-- > 0;)
            fronts[--begin[relations[i].back]] = relations[i].front;
}

template <int row, class State>
void run_frame(const Frame<row, State>& frame, std::span<const CellId> caller_cells,
               std::span<const Relation> tentative, std::vector<Front>& fronts, std::vector<std::uint32_t>& cursors,
               Order& order)
{
    const auto threads = concurrency();
    if (threads == 1 || frame.cells < worth_a_team) {
        fronts.resize(1);
        list_alone(frame, fronts);
    } else {
        std::vector<Published> published;
        Team::run(std::min(threads, most_members), [&](Team& team, std::size_t me) {
            if (me == 0) {
                fronts.resize(team.size());
                published = std::vector<Published>(team.size());
            }
            team.wait_for_all();
            if (team.size() == 1)
                list_alone(frame, fronts);
            else
                list_together(frame, fronts, published, team, me);
        });
    }

    std::vector<std::uint32_t> level_counts;
    std::size_t listed = 0;
    for (const Front& front : fronts) {
        level_counts.resize(std::max(level_counts.size(), front.level_counts.size()), 0);
        for (std::size_t l = 0; l < front.level_counts.size(); ++l) {
            level_counts[l] += front.level_counts[l];
            listed += front.level_counts[l];
        }
    }
    while (!level_counts.empty() && level_counts.back() == 0)
        level_counts.pop_back();
    order.cycles.clear();
    if (listed < frame.cells)
        list_cycles(frame, caller_cells, tentative, level_counts, order.cycles);
    order.layer_begin.resize(level_counts.size());
    std::exclusive_scan(level_counts.begin(), level_counts.end(), order.layer_begin.begin(), 0u);
    resize_on_large_pages(order.back_to_front, frame.cells);
    write_order({frame.level, frame.cells}, caller_cells, cursors, order);
}

} // namespace

template <int row, class State>
void TopologicalSort::run_over(const Scene& scene, const FaceSigns* signs, std::span<const Relation> more,
                               std::span<const Relation> tentative, LargeArray<State>& state, Order& order)
{
    const CellId cells = scene.cell_count();
    level_.resize(cells);
    state.resize(cells);
    Frame<row, State> frame{nullptr, state.data(), level_.data(), cells, nullptr, nullptr};
    if constexpr (row > 0) {
        frame.neighbour = scene.adjacency().neighbour.data();
        count_relations<row>(scene.adjacency(), *signs, state.data(), cells);
    } else {
        std::fill(state.begin(), state.end(), State{0});
    }
    if (!more.empty() || !tentative.empty()) {
        group_by_back(more, tentative, cells, more_begin_, more_front_);
        frame.more_begin = more_begin_.data();
        frame.more_front = more_front_.data();
        for (const auto& relations : {more, tentative})
            for (const Relation& r : relations)
                state[r.front] = static_cast<State>(state[r.front] + Frame<row, State>::one);
    }
    run_frame(frame, scene.caller_cells(), tentative, fronts_, cursors_, order);
}

void TopologicalSort::run(const Scene& scene, const FaceSigns& signs, std::span<const Relation> more,
                          std::span<const Relation> tentative, Order& order)
{
    if (scene.adjacency().row_length == 4 && more.empty() && tentative.empty())
        run_over<4>(scene, &signs, more, tentative, small_state_, order);
    else if (scene.adjacency().row_length == 4)
        run_over<4>(scene, &signs, more, tentative, large_state_, order);
    else
        run_over<6>(scene, &signs, more, tentative, large_state_, order);
}

void TopologicalSort::run(const Scene& scene, std::span<const Relation> relations, Order& order)
{
    run_over<0>(scene, nullptr, relations, {}, large_state_, order);
}

std::size_t TopologicalSort::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    std::size_t sum = size_of(small_state_) + size_of(large_state_) + size_of(level_) + size_of(more_begin_) +
                      size_of(more_front_) + size_of(cursors_);
    for (const Front& front : fronts_) {
        sum += size_of(front.now) + size_of(front.next) + size_of(front.level_counts);
        for (const auto& boxes : front.out)
            for (const auto& box : boxes)
                sum += size_of(box);
    }
    return sum;
}

} // namespace visorder::detail
