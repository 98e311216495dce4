#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace visorder::detail {

/// An edge between nodes 0 to n-1: `before` is to be listed before `after`.
struct Precedence {
    std::uint32_t before;
    std::uint32_t after;
    bool tentative; ///< to be given up where it contradicts others
};

/// A sequence of nodes that satisfies all edges but those within `cycles` and the tentative ones that are given up.
struct CyclicOrder {
    std::vector<std::uint32_t> level; ///< per node; of the two nodes of a satisfied edge, `before` has the lower one
    std::uint32_t level_count = 0;
    /// Strongly connected sets of more than one node, under the edges that are not tentative.
    std::vector<std::vector<std::uint32_t>> cycles;
};

/// Orders nodes whose edges may run in circles. Strongly connected sets under all edges come one after the other.
/// Within one, its strongly connected sets under the edges that are not tentative do, always one with the fewest
/// tentative edges unsatisfied; and within these, the nodes, always one with the fewest edges unsatisfied.
CyclicOrder order_with_cycles(std::uint32_t node_count, std::span<const Precedence> edges);

} // namespace visorder::detail
