#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace visorder::detail {

/// A directed graph over nodes 0 to n-1: the successors of node i are successors[begin[i]] up to
/// successors[begin[i + 1]].
struct Graph {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> successors;

    std::uint32_t node_count() const { return static_cast<std::uint32_t>(begin.size() - 1); }
    std::span<const std::uint32_t> of(std::uint32_t node) const
    {
        return {successors.data() + begin[node], successors.data() + begin[node + 1]};
    }
};

/// Makes the graph of edges (from[i], to[i]).
Graph graph_of(std::uint32_t node_count, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to);

/// The strongly connected components of a graph (Tarjan 1972, without recursion). Components are numbered so that every
/// edge between two leads from the higher number to the lower.
struct Components {
    std::vector<std::uint32_t> of_node;
    std::uint32_t count = 0;
};
Components strongly_connected_components(const Graph& graph);

} // namespace visorder::detail
