#pragma once

#include "parallel/large_array.h"
#include "scene/adjacency.h"
#include "scene/face_planes.h"
#include "visorder/relation.h"
#include "visorder/sorter.h"

#include <cstdint>
#include <span>
#include <vector>

namespace visorder::detail {

/// The topological sort that all sorters over relations share (Max, Williams, Silva 2000, section III; Kahn 1962):
/// first the cells that occlude nothing, then level by level those that occlude only cells already listed. Within a
/// level cells stand in the Scene's inner order, so the Order is the same for any number of threads. Linear in cells
/// and relations.
///
/// Each level becomes a layer of the Order. Where relations run in circles, the strongly connected sets are reported as
/// `cycles`, and the cells in and behind them are listed all the same: each set one cell at a time, always one with the
/// fewest relations unsatisfied.
///
/// Keeps its memory from frame to frame. One `run` at a time on one object.
class TopologicalSort {
public:
    /// Orders the cells of `scene` by the relations across its interior faces, as `signs` has them for an eye, and by
    /// `more` of them.
    void run(const Scene& scene, const FaceSigns& signs, std::span<const Relation> more, Order& order)
    {
        run(scene, signs, more, {}, order);
    }

    /// Likewise, and by `tentative` relations (see tentative_relations.h) as far as they contradict neither these nor
    /// each other.
    void run(const Scene& scene, const FaceSigns& signs, std::span<const Relation> more,
             std::span<const Relation> tentative, Order& order);

    /// The same by `relations` alone, such as those of a surface, whose triangles' common edges say nothing.
    void run(const Scene& scene, std::span<const Relation> relations, Order& order);

    std::size_t bytes() const;

    /// The frontier of one thread; see topological_sort.cpp.
    struct Front {
        LargeArray<CellId> now;
        LargeArray<CellId> next;
        std::vector<LargeArray<CellId>> out[2]; // by parity of the level, to each other member
        std::vector<std::uint32_t> level_counts;
    };

private:
    template <int row, class State>
    void run_over(const Scene& scene, const FaceSigns* signs, std::span<const Relation> more,
                  std::span<const Relation> tentative, LargeArray<State>& state, Order& order);

    LargeArray<std::uint8_t> small_state_;  // a tetrahedron without more relations
    LargeArray<std::uint32_t> large_state_; // any other cell
    LargeArray<std::uint32_t> level_;
    std::vector<Front> fronts_;
    std::vector<std::uint32_t> more_begin_; // of each back cell's fronts in more_front_; empty if there are none
    std::vector<CellId> more_front_;
    std::vector<std::uint32_t> cursors_;
};

} // namespace visorder::detail
