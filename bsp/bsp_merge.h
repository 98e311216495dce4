#pragma once

#include "bsp/bsp_xmpvo.h"
#include "parallel/concurrency.h"
#include "parallel/team.h"
#include "scene/adjacency.h"
#include "scene/face_planes.h"
#include "scene/face_set.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <span>
#include <utility>
#include <vector>

namespace visorder::detail {

/// One frame of BspXmpvo: lists the cells. A cell's state holds, in the lowest `row` bits, its interior entry faces;
/// then one bit if it has boundary faces in the tree; above, behind how many of its interior exit faces the cell is not
/// listed. At zero it is ready, and waits in the queue to be listed.
template <int row, class State>
class BspMerge {
public:
    BspMerge(BspXmpvo& sorter, State* state, Order& order)
        : sorter_(sorter),
          state_(state),
          neighbour_(row > 0 ? sorter.scene_.adjacency().neighbour.data() : nullptr),
          order_(order.back_to_front.data())
    {
    }

    /// Returns how many cells were listed; fewer than all where relations run in circles.
    std::size_t run()
    {
        oneapi::tbb::parallel_invoke(
            [&] {
                count();
                list_queue();
            },
            [&] { sorter_.reset_pending(); });
        list();
        number_as_caller();
        return listed_;
    }

private:
    using BoundaryCell = BspXmpvo::BoundaryCell;

    static constexpr std::uint32_t none = BspXmpvo::no_cell; // and no face
    static constexpr std::size_t worth_a_team = 1 << 12;     // boundary cells; with fewer, one thread does all
    static constexpr std::size_t most_members = 16;          // in a team
    static constexpr std::size_t least_looks = 32;           // of cells in a step, if there are as many to do
    static constexpr std::size_t most_looks = 64;            // likewise: steps of one size keep all threads busy
    static constexpr std::size_t looks_at_once = 16;         // of one thread
    static constexpr std::size_t prefetch_rows = 32;
    static constexpr std::size_t prefetch_states = 12;
    static constexpr std::size_t prefetch_cells = 8;

    static constexpr State at_boundary = State{1} << row;
    static constexpr State one = State{2} << row;

    static bool ready(State s) { return s < one; }

    // Until then the order speaks of inner cells: a scattered read less where one thread lists.
    void number_as_caller()
    {
        const CellId* const caller_cells = sorter_.scene_.caller_cells().data();
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, listed_, 16384), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                order_[i] = caller_cells[order_[i]];
        });
    }

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
        for (const BoundaryCell& cell : sorter_.cells_)
            state_[cell.cell] = static_cast<State>(state_[cell.cell] | at_boundary);
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

    // Lists the cells that are ready, and those that become so, in steps. In a step all that wait in the queue are
    // listed, and side by side with that, some ready cells with boundary exit faces look for what they cover, among
    // what was pending when the step began: so an order does not depend on which thread does what. Farthest first, when
    // most of what they may cover has been listed.
    void list()
    {
        const std::size_t most =
            sorter_.boundary_cells_.count() < worth_a_team ? 1 : std::min(concurrency(), most_members);
        sorter_.workspaces_.resize(std::max(most, sorter_.workspaces_.size()));
        Team::run(most, [&](Team& team, std::size_t member) {
            if (member == 0)
                lead(team, sorter_.workspaces_[0]);
            else
                follow(team, sorter_.workspaces_[member]);
        });
    }

    void lead(Team& team, CoverSearch::Workspace& workspace)
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
            look_for_covered(workspace);
            team.wait_for_all();
            end_step();
        }
        team.wait_for_all();
    }

    void follow(Team& team, CoverSearch::Workspace& workspace)
    {
        while (true) {
            team.wait_for_all();
            if (sorter_.looking_.empty())
                return;
            look_for_covered(workspace);
            team.wait_for_all();
        }
    }

    // Of the ready cells that are still to look, some in the farthest slabs, and their exit faces.
    void take_farthest()
    {
        sorter_.looking_.clear();
        sorter_.exits_.clear();
        while (farthest_ > 0 && sorter_.looking_.size() < least_looks) {
            std::vector<std::uint32_t>& deferred = sorter_.deferred_[farthest_ - 1];
            const std::size_t kept = deferred.size() - std::min(deferred.size(), most_looks - sorter_.looking_.size());
            sorter_.looking_.insert(sorter_.looking_.end(), deferred.begin() + static_cast<std::ptrdiff_t>(kept),
                                    deferred.end());
            deferred.resize(kept);
            farthest_ -= kept == 0 ? 1 : 0;
        }
        const std::span<const std::uint32_t> looking = sorter_.looking_;
        for (std::size_t i = 0; i < looking.size(); ++i) {
            if (i + prefetch_cells < looking.size())
                __builtin_prefetch(&sorter_.cells_[looking[i + prefetch_cells]]);
            each_face(looking[i], sorter_.cells_[looking[i]].exits,
                      [&](std::uint32_t face) { sorter_.exits_.push_back(face); });
        }
        sorter_.covered_.resize(sorter_.exits_.size());
    }

    // This thread's share.
    void look_for_covered(CoverSearch::Workspace& workspace)
    {
        const std::size_t all = sorter_.exits_.size();
        while (true) {
            const std::size_t begin = next_look_.fetch_add(looks_at_once, std::memory_order_relaxed);
            if (begin >= all)
                return;
            const std::size_t count = std::min(looks_at_once, all - begin);
            sorter_.cover_search_.find(std::span(sorter_.exits_).subspan(begin, count),
                                       std::span(sorter_.covered_).subspan(begin, count), workspace);
        }
    }

    // What looked and covers nothing goes back to the queue to be listed; the others wait for the cell of the face that
    // they cover, or look again if it has been listed meanwhile. The faces of what was listed are gone.
    void end_step()
    {
        const std::uint32_t* covered = sorter_.covered_.data();
        for (const std::uint32_t boundary_cell : sorter_.looking_) {
            BoundaryCell& cell = sorter_.cells_[boundary_cell];
            std::uint32_t covered_face = none;
            for (unsigned exits = cell.exits; exits != 0; exits &= exits - 1, ++covered)
                covered_face = covered_face == none ? *covered : covered_face;
            if (covered_face == none) {
                list_boundary_cell(boundary_cell);
                sorter_.queue_[ready_++] = cell.cell;
                state_[cell.cell] = static_cast<State>(state_[cell.cell] & ~at_boundary);
                if constexpr (row > 0)
                    __builtin_prefetch(neighbour_ + std::size_t{cell.cell} * row);
                continue;
            }
            BoundaryCell& of_face = sorter_.cells_[sorter_.boundary_cells_.of_face(covered_face)];
            if (of_face.is_listed) {
                defer(boundary_cell);
                continue;
            }
            ++sorter_.relation_count_;
            cell.next = std::exchange(of_face.waiting_head, boundary_cell);
        }
        for (const std::uint32_t boundary_cell : sorter_.listed_in_step_)
            each_face(boundary_cell, sorter_.cells_[boundary_cell].entries,
                      [&](std::uint32_t face) { sorter_.cover_search_.remove(face); });
        sorter_.listed_in_step_.clear();
    }

    template <class Visit>
    void each_face(std::uint32_t boundary_cell, unsigned bits, Visit&& visit) const
    {
        for (std::uint32_t face = sorter_.cells_[boundary_cell].first_face; bits != 0; ++face, bits >>= 1)
            if ((bits & 1) != 0)
                visit(face);
    }

    void defer(std::uint32_t boundary_cell)
    {
        const std::uint8_t slab = sorter_.slabs_[boundary_cell];
        sorter_.deferred_[slab].push_back(boundary_cell);
        farthest_ = std::max<std::size_t>(farthest_, slab + 1u);
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
            order_[listed_++] = cell;
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

    // Whether a boundary cell that has become ready is to be listed now: if it has no exit face there.
    bool come_to_boundary_cell(CellId cell)
    {
        const std::uint32_t boundary_cell = sorter_.boundary_cells_.of_cell(cell);
        if ((sorter_.blocked_[boundary_cell] -= BspXmpvo::not_ready) != 0)
            return false;
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
        BoundaryCell& cell = sorter_.cells_[boundary_cell];
        cell.is_listed = true;
        if (cell.entries != 0)
            sorter_.listed_in_step_.push_back(boundary_cell);
        std::uint32_t waiting = std::exchange(cell.waiting_head, none);
        while (waiting != none) {
            const std::uint32_t next = sorter_.cells_[waiting].next;
            defer(waiting);
            waiting = next;
        }
        for (std::uint32_t i = cell.front_begin; i < cell.front_end; ++i)
            if (--sorter_.blocked_[sorter_.fronts_[i]] == 0)
                defer(sorter_.fronts_[i]);
    }

    BspXmpvo& sorter_;
    State* state_;
    const CellId* neighbour_;
    CellId* order_;
    std::size_t queue_begin_ = 0;
    std::size_t ready_ = 0;
    std::size_t listed_ = 0;
    std::size_t farthest_ = 0;              // one more than the farthest slab that may hold deferred cells
    std::atomic<std::size_t> next_look_{0}; // of this step
};

} // namespace visorder::detail
