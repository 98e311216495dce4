#pragma once

#include "bsp/bsp_xmpvo.h"
#include "scene/concurrency.h"
#include "sorting/team.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <utility>
#include <vector>

namespace visorder {

/// One frame of BspXmpvo: lists the cells. A cell's state holds, in the lowest `row` bits, its interior entry faces;
/// then one bit if it has boundary faces in the tree; above, behind how many of its interior exit faces the cell is not
/// listed. At zero it is ready, and waits in the queue to be listed.
template <int row, class State>
class BspMerge {
public:
    BspMerge(BspXmpvo& sorter, State* state, const glm::dvec4& eye, Order& order)
        : sorter_(sorter),
          eye_(eye),
          state_(state),
          neighbour_(row > 0 ? sorter.scene_.adjacency().neighbour.data() : nullptr),
          caller_cells_(sorter.scene_.caller_cells().data()),
          order_(order.back_to_front.data())
    {
    }

    /// Returns how many cells were listed; fewer than all where relations run in circles.
    std::size_t run()
    {
        oneapi::tbb::parallel_invoke([&] { count(); }, [&] { sorter_.reset_pending(); });
        list();
        return listed_;
    }

private:
    using Tests = BspXmpvo::Tests;

    static constexpr std::uint32_t none = BspXmpvo::no_cell; // and no face
    static constexpr std::size_t worth_a_team = 1 << 12;     // boundary cells; with fewer, one thread lists
    static constexpr std::size_t most_members = 16;          // in a team
    static constexpr std::size_t least_looks = 16;           // in a step, if there are as many to do
    static constexpr std::size_t looks_at_once = 4;          // of one thread
    static constexpr std::size_t prefetch_rows = 32;
    static constexpr std::size_t prefetch_states = 12;

    static constexpr State at_boundary = State{1} << row;
    static constexpr State one = State{2} << row;

    static bool ready(State s) { return s < one; }
    CellId owner(std::uint32_t face) const { return sorter_.tree_.faces()[face].cell; }

    void count()
    {
        const CellId cells = sorter_.scene_.cell_count();
        if constexpr (row > 0) {
            const Adjacency& adjacency = sorter_.scene_.adjacency();
            const FaceSigns& signs = sorter_.signs_;
            oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, cells, 16384), [&](const auto& range) {
                for (CellId cell = range.begin(); cell < range.end(); ++cell) {
                    const std::uint32_t interior = adjacency.interior[cell];
                    const std::uint32_t obstructed = bits_set[signs.exit(cell) & interior];
                    state_[cell] = static_cast<State>((signs.entry(cell) & interior) | obstructed * one);
                }
            });
        } else {
            std::fill_n(state_, cells, State{0});
        }
        for (std::size_t i = 0; i < sorter_.boundary_cells_.count(); ++i) {
            State& state = state_[owner(sorter_.boundary_cells_.faces(i).first)];
            state = static_cast<State>(state | at_boundary);
        }
        // A boundary cell can be there twice: when it is ready, and when it may be listed.
        sorter_.queue_.resize(cells + sorter_.boundary_cells_.count() + 1);
        CellId* const queue = sorter_.queue_.data();
        for (CellId cell = 0; cell < cells; ++cell) {
            if (cell + 8 <= cells && none_of_eight_ready(state_ + cell)) {
                cell += 7;
                continue;
            }
            queue[ready_] = cell;
            ready_ += ready(state_[cell]);
        }
    }

    // Few cells are ready at first: states of one byte are passed over eight at a time.
    static bool none_of_eight_ready(const State* states)
    {
        if constexpr (sizeof(State) > 1 || row == 0) {
            return false;
        } else {
            std::uint64_t eight;
            std::memcpy(&eight, states, sizeof eight);
            // The counts, three bits each: none is zero if adding 7 to every one carries out of all of them.
            const std::uint64_t counts = eight >> (row + 1) & 0x0707070707070707u;
            return ((counts + 0x0707070707070707u) & 0x0808080808080808u) == 0x0808080808080808u;
        }
    }

    bool is_listed(std::uint32_t boundary_cell) const { return sorter_.is_listed_[boundary_cell] != 0; }

    // Lists the cells that are ready, and those that become so, in steps. In a step all that wait in the queue are
    // listed, and side by side with that, some ready cells with boundary exit faces look for what they cover, among
    // what was pending when the step began: so an order does not depend on which thread does what. Farthest first, when
    // most of what they may cover has been listed.
    void list()
    {
        const std::size_t most =
            sorter_.boundary_cells_.count() < worth_a_team ? 1 : std::min(concurrency(), most_members);
        std::array<Tests, most_members> tests{};
        Team::run(most, [&](Team& team, std::size_t member) {
            Tests of_member; // not yet beside those of others: lines that two write go to and fro
            if (member == 0)
                lead(team, of_member);
            else
                follow(team, of_member);
            tests[member] = of_member;
        });
        for (const Tests& of_member : tests) {
            sorter_.tests_.all += of_member.all;
            sorter_.tests_.exact += of_member.exact;
        }
    }

    void lead(Team& team, Tests& tests)
    {
        while (true) {
            take_farthest();
            if (sorter_.looking_.empty()) {
                list_queue();
                take_farthest();
            }
            if (sorter_.looking_.empty())
                break;
            next_look_.store(0, std::memory_order_relaxed);
            team.wait_for_all();
            list_queue();
            look_for_covered(tests);
            team.wait_for_all();
            end_step();
        }
        team.wait_for_all();
    }

    void follow(Team& team, Tests& tests)
    {
        while (true) {
            team.wait_for_all();
            if (sorter_.looking_.empty())
                return;
            look_for_covered(tests);
            team.wait_for_all();
        }
    }

    // Of the ready cells that are still to look, those in the farthest slabs.
    void take_farthest()
    {
        std::vector<std::uint32_t>& looking = sorter_.looking_;
        looking.clear();
        for (; farthest_ > 0 && looking.size() < least_looks; --farthest_)
            for (std::uint32_t cell = std::exchange(sorter_.deferred_[farthest_ - 1], none); cell != none;
                 cell = sorter_.next_[cell])
                looking.push_back(cell);
        sorter_.covered_.resize(looking.size());
    }

    // This thread's share.
    void look_for_covered(Tests& tests)
    {
        const std::size_t all = sorter_.looking_.size();
        while (true) {
            const std::size_t begin = next_look_.fetch_add(looks_at_once, std::memory_order_relaxed);
            if (begin >= all)
                return;
            for (std::size_t i = begin; i < std::min(begin + looks_at_once, all); ++i)
                sorter_.covered_[i] = covered_by(sorter_.looking_[i], tests);
        }
    }

    // A pending face that some exit face of the cell covers, or none: a near one, whose cell is likely to be listed
    // last.
    std::uint32_t covered_by(std::uint32_t boundary_cell, Tests& tests)
    {
        const auto [begin, end] = sorter_.boundary_cells_.faces(boundary_cell);
        std::uint32_t covered = none;
        for (std::uint32_t face = begin; face < end && covered == none; ++face)
            if ((sorter_.roles_[face] & BspXmpvo::exit_role) != 0)
                sorter_.pending_.search(
                    face, [&](std::uint32_t entry) { sorter_.heights_.prefetch(entry); },
                    [&](std::uint32_t entry) {
                        if (sorter_.obstructs(face, entry, eye_, tests))
                            covered = entry;
                        return covered == none;
                    });
        return covered;
    }

    // What looked and covers nothing goes back to the queue to be listed; the others wait for the cell of the face that
    // they cover, or look again if it has been listed meanwhile. The faces of what was listed are gone.
    void end_step()
    {
        for (std::size_t i = 0; i < sorter_.looking_.size(); ++i) {
            const std::uint32_t boundary_cell = sorter_.looking_[i];
            if (sorter_.covered_[i] == none) {
                list_boundary_cell(boundary_cell);
                sorter_.queue_[ready_++] = owner(sorter_.boundary_cells_.faces(boundary_cell).first);
                continue;
            }
            const std::uint32_t covered = sorter_.boundary_cells_.of_face(sorter_.covered_[i]);
            if (is_listed(covered)) {
                defer(boundary_cell);
                continue;
            }
            ++sorter_.relation_count_;
            sorter_.next_[boundary_cell] = std::exchange(sorter_.waiting_head_[covered], boundary_cell);
        }
        for (std::uint32_t boundary_cell : sorter_.listed_in_step_)
            remove_faces(boundary_cell);
        sorter_.listed_in_step_.clear();
    }

    void remove_faces(std::uint32_t boundary_cell)
    {
        const auto [begin, end] = sorter_.boundary_cells_.faces(boundary_cell);
        for (std::uint32_t face = begin; face < end; ++face)
            if ((sorter_.roles_[face] & BspXmpvo::entry_role) != 0)
                sorter_.pending_.remove(face);
    }

    void defer(std::uint32_t boundary_cell)
    {
        const std::uint32_t slab = sorter_.slabs_[boundary_cell];
        sorter_.next_[boundary_cell] = std::exchange(sorter_.deferred_[slab], boundary_cell);
        farthest_ = std::max<std::size_t>(farthest_, slab + 1);
    }

    void list_queue()
    {
        // Held in local variables: the compiler takes a store of a byte to change anything that is not local.
        State* const state = state_;
        const CellId* const neighbour = neighbour_;
        CellId* const queue = sorter_.queue_.data();
        std::size_t ready_end = ready_;
        for (std::size_t at = queue_begin_; at < ready_end; ++at) {
            if (at + prefetch_rows < ready_end) {
                const CellId ahead = queue[at + prefetch_rows];
                __builtin_prefetch(caller_cells_ + ahead);
                if constexpr (row > 0) {
                    __builtin_prefetch(neighbour + std::size_t{ahead} * row);
                    const CellId* soon = neighbour + std::size_t{queue[at + prefetch_states]} * row;
                    for (int f = 0; f < row; ++f)
                        __builtin_prefetch(state + soon[f], 1);
                }
            } else if constexpr (row > 0) {
                // What is to come is not known yet; it is one of these.
                const CellId* across = neighbour + std::size_t{queue[at]} * row;
                for (int f = 0; f < row; ++f)
                    __builtin_prefetch(neighbour + std::size_t{across[f]} * row);
            }
            const CellId cell = queue[at];
            const State s = state[cell];
            if ((s & at_boundary) != 0 && !come_to_boundary_cell(cell))
                continue;
            order_[listed_++] = caller_cells_[cell];
            if constexpr (row > 0) {
                const CellId* across = neighbour + std::size_t{cell} * row;
                for (int f = 0; f < row; ++f) {
                    const auto holds = static_cast<State>(s >> f & 1u);
                    const auto left = static_cast<State>(state[across[f]] - holds * one);
                    state[across[f]] = left;
                    queue[ready_end] = across[f];
                    ready_end += holds & static_cast<State>(ready(left));
                }
            }
        }
        queue_begin_ = ready_ = ready_end;
    }

    // Whether a ready boundary cell is to be listed now: if it has no exit face there, or covers nothing any more.
    bool come_to_boundary_cell(CellId cell)
    {
        const auto boundary_cell = static_cast<std::uint32_t>(sorter_.boundary_cells_.of_cell(cell));
        if (is_listed(boundary_cell))
            return true;
        if (sorter_.slabs_[boundary_cell] != BspXmpvo::no_slab) {
            defer(boundary_cell);
            return false;
        }
        list_boundary_cell(boundary_cell);
        return true;
    }

    // What waited for the cell looks again for what it covers.
    void list_boundary_cell(std::uint32_t boundary_cell)
    {
        sorter_.is_listed_[boundary_cell] = 1;
        sorter_.listed_in_step_.push_back(boundary_cell);
        std::uint32_t waiting = std::exchange(sorter_.waiting_head_[boundary_cell], none);
        while (waiting != none) {
            const std::uint32_t next = sorter_.next_[waiting];
            defer(waiting);
            waiting = next;
        }
    }

    BspXmpvo& sorter_;
    const glm::dvec4& eye_;
    State* state_;
    const CellId* neighbour_;
    const CellId* caller_cells_;
    CellId* order_;
    std::size_t queue_begin_ = 0;
    std::size_t ready_ = 0;
    std::size_t listed_ = 0;
    std::size_t farthest_ = 0;              // one more than the farthest slab that may hold deferred cells
    std::atomic<std::size_t> next_look_{0}; // of this step
};

} // namespace visorder
