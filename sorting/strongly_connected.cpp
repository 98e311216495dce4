#include "sorting/strongly_connected.h"

#include <algorithm>
#include <limits>

namespace visorder::detail {

Graph graph_of(std::uint32_t node_count, std::span<const std::uint32_t> from, std::span<const std::uint32_t> to)
{
    Graph graph;
    graph.begin.assign(node_count + 1, 0);
    graph.successors.resize(from.size());
    for (std::uint32_t node : from)
        ++graph.begin[node];
    std::uint32_t end = 0;
    for (std::uint32_t& count : graph.begin)
        count = end += count;
    for (std::size_t i = from.size(); i-- > 0;)
        graph.successors[--graph.begin[from[i]]] = to[i];
    return graph;
}

Components strongly_connected_components(const Graph& graph)
{
    constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
    const std::uint32_t n = graph.node_count();
    Components components;
    components.of_node.assign(n, unseen);
    std::vector<std::uint32_t> index(n, unseen), lowest(n), next(graph.begin.begin(), graph.begin.end() - 1);
    std::vector<std::uint32_t> path, open;
    std::uint32_t visited = 0;
    for (std::uint32_t start = 0; start < n; ++start) {
        if (index[start] != unseen)
            continue;
        path.push_back(start);
        while (!path.empty()) {
            const std::uint32_t node = path.back();
            if (index[node] == unseen) {
                index[node] = lowest[node] = visited++;
                open.push_back(node);
            }
            bool descended = false;
            while (next[node] < graph.begin[node + 1]) {
                const std::uint32_t successor = graph.successors[next[node]];
                if (index[successor] == unseen) {
                    path.push_back(successor);
                    descended = true;
                    break;
                }
                // Still open: `successor` is on the way here, or reaches it.
                if (components.of_node[successor] == unseen)
                    lowest[node] = std::min(lowest[node], lowest[successor]);
                ++next[node];
            }
            if (descended)
                continue;
            path.pop_back();
            if (lowest[node] != index[node])
                continue;
            std::uint32_t member;
            do {
                member = open.back();
                open.pop_back();
                components.of_node[member] = components.count;
            } while (member != node);
            ++components.count;
        }
    }
    return components;
}

} // namespace visorder::detail
