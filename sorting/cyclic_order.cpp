#include "sorting/cyclic_order.h"

#include "sorting/strongly_connected.h"

#include <algorithm>
#include <set>
#include <utility>

namespace visorder::detail {

namespace {

Graph graph_of_edges(std::uint32_t nodes, std::span<const Precedence> edges, bool with_tentative)
{
    std::vector<std::uint32_t> from, to;
    for (const Precedence& edge : edges)
        if (with_tentative || !edge.tentative) {
            from.push_back(edge.before);
            to.push_back(edge.after);
        }
    return graph_of(nodes, from, to);
}

std::vector<std::vector<std::uint32_t>> members_of(const Components& components)
{
    std::vector<std::vector<std::uint32_t>> members(components.count);
    for (std::uint32_t node = 0; node < components.of_node.size(); ++node)
        members[components.of_node[node]].push_back(node);
    return members;
}

// Items, each with a count of edges that are not satisfied yet; the one with the fewest comes next.
class FewestFirst {
public:
    explicit FewestFirst(std::size_t nodes) : unsatisfied_(nodes, 0) {}

    void count(std::uint32_t item) { ++unsatisfied_[item]; }
    void insert(std::uint32_t item) { waiting_.emplace(unsatisfied_[item], item); }
    bool empty() const { return waiting_.empty(); }
    std::uint32_t take()
    {
        const std::uint32_t item = waiting_.begin()->second;
        waiting_.erase(waiting_.begin());
        return item;
    }
    void satisfy(std::uint32_t item)
    {
        const auto at = waiting_.find({unsatisfied_[item], item});
        --unsatisfied_[item];
        if (at != waiting_.end()) {
            waiting_.erase(at);
            insert(item);
        }
    }

private:
    std::vector<std::uint32_t> unsatisfied_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> waiting_;
};

class Ordering {
public:
    Ordering(std::uint32_t nodes, std::span<const Precedence> edges)
        : all_(graph_of_edges(nodes, edges, true)),
          firm_(graph_of_edges(nodes, edges, false)),
          sets_(strongly_connected_components(all_)),
          cycles_(strongly_connected_components(firm_)),
          members_of_cycle_(members_of(cycles_)),
          unsatisfied_firm_(cycles_.count, 0),
          cycles_first_(cycles_.count),
          nodes_first_(nodes)
    {
        order_.level.resize(nodes);
    }

    CyclicOrder run()
    {
        const std::vector<std::vector<std::uint32_t>> members = members_of(sets_);
        // A set takes as many levels as it has nodes, after all levels of those that come before it.
        std::vector<std::uint32_t> start(sets_.count, 0);
        for (std::uint32_t set = sets_.count; set-- > 0;) {
            const auto end = start[set] + static_cast<std::uint32_t>(members[set].size());
            order_.level_count = std::max(order_.level_count, end);
            for (const std::uint32_t node : members[set])
                for (const std::uint32_t after : all_.of(node))
                    if (sets_.of_node[after] != set)
                        start[sets_.of_node[after]] = std::max(start[sets_.of_node[after]], end);
            level_ = start[set];
            list_set(members[set]);
        }
        for (std::vector<std::uint32_t>& cycle : members_of_cycle_)
            if (cycle.size() > 1)
                order_.cycles.push_back(std::move(cycle));
        return std::move(order_);
    }

private:
    // The strongly connected sets under firm edges, one after the other.
    void list_set(const std::vector<std::uint32_t>& set)
    {
        std::vector<std::uint32_t> in_set;
        for (const std::uint32_t node : set)
            in_set.push_back(cycles_.of_node[node]);
        std::sort(in_set.begin(), in_set.end());
        in_set.erase(std::unique(in_set.begin(), in_set.end()), in_set.end());
        if (in_set.size() == 1) {
            list_cycle(in_set.front());
            return;
        }
        each_edge_within(set, [&](std::uint32_t, std::uint32_t after, bool firm) {
            if (firm)
                ++unsatisfied_firm_[after];
            else
                cycles_first_.count(after);
        });
        for (const std::uint32_t cycle : in_set)
            if (unsatisfied_firm_[cycle] == 0)
                cycles_first_.insert(cycle);
        while (!cycles_first_.empty()) {
            const std::uint32_t cycle = cycles_first_.take();
            list_cycle(cycle);
            each_edge_within(members_of_cycle_[cycle], [&](std::uint32_t, std::uint32_t after, bool firm) {
                if (!firm)
                    cycles_first_.satisfy(after);
                else if (--unsatisfied_firm_[after] == 0)
                    cycles_first_.insert(after);
            });
        }
    }

    // Of nodes of one set, the edges that lead from one cycle of it to another; tentative ones, too, that are firm at
    // the same time.
    template <class Visit>
    void each_edge_within(const std::vector<std::uint32_t>& nodes, Visit&& visit) const
    {
        const auto edges_of = [&](const Graph& graph, bool firm) {
            for (const std::uint32_t node : nodes)
                for (const std::uint32_t after : graph.of(node))
                    if (sets_.of_node[node] == sets_.of_node[after] && cycles_.of_node[node] != cycles_.of_node[after])
                        visit(cycles_.of_node[node], cycles_.of_node[after], firm);
        };
        edges_of(all_, false);
        edges_of(firm_, true);
    }

    void list_cycle(std::uint32_t cycle)
    {
        const std::vector<std::uint32_t>& nodes = members_of_cycle_[cycle];
        for (const std::uint32_t node : nodes)
            for (const std::uint32_t after : all_.of(node))
                if (cycles_.of_node[after] == cycle)
                    nodes_first_.count(after);
        for (const std::uint32_t node : nodes)
            nodes_first_.insert(node);
        while (!nodes_first_.empty()) {
            const std::uint32_t node = nodes_first_.take();
            order_.level[node] = level_++;
            for (const std::uint32_t after : all_.of(node))
                if (cycles_.of_node[after] == cycle)
                    nodes_first_.satisfy(after);
        }
    }

    Graph all_, firm_;
    Components sets_, cycles_; // strongly connected under all edges, and under the firm ones
    std::vector<std::vector<std::uint32_t>> members_of_cycle_;
    std::vector<std::uint32_t> unsatisfied_firm_; // per cycle
    FewestFirst cycles_first_, nodes_first_;
    std::uint32_t level_ = 0;
    CyclicOrder order_;
};

} // namespace

CyclicOrder order_with_cycles(std::uint32_t node_count, std::span<const Precedence> edges)
{
    return Ordering(node_count, edges).run();
}

} // namespace visorder::detail
