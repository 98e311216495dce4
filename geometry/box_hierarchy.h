#pragma once

#include "visorder/box.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace visorder::detail {

/// A bounding-volume hierarchy over boxes, which a search walks depth first: `visit_boxes` for those a predicate on
/// boxes keeps. Built over the boxes in the order of a Morton curve through their middles, halved level by level.
/// Immutable; any number of threads may search it.
class BoxHierarchy {
public:
    explicit BoxHierarchy(std::span<const Box> boxes);

    /// Calls `visit(i)` for each box i with `keep(box)`, and `keep` also for the boxes around whole subtrees: it must
    /// keep a box that holds one it keeps. `visit` returns whether to go on.
    template <class Keep, class Visit>
    void search(Keep&& keep, Visit&& visit) const;

private:
    static constexpr std::uint32_t leaf_size = 4;
    struct Node {
        Box box;
        std::uint32_t begin, end; // of the items below, as places in items_
        std::uint32_t right;      // the left child is the next node; 0 in a leaf
    };

    std::uint32_t build(std::uint32_t begin, std::uint32_t end);

    std::vector<std::pair<Box, std::uint32_t>> items_; // along the curve, with the caller's number of each
    std::vector<Node> nodes_;
};

template <class Keep, class Visit>
void BoxHierarchy::search(Keep&& keep, Visit&& visit) const
{
    if (nodes_.empty())
        return;
    std::uint32_t stack[64];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t i = stack[--depth];
        const Node& node = nodes_[i];
        if (!keep(node.box))
            continue;
        if (node.right != 0) {
            stack[depth++] = node.right;
            stack[depth++] = i + 1;
            continue;
        }
        for (std::uint32_t k = node.begin; k < node.end; ++k)
            if (keep(items_[k].first) && !visit(items_[k].second))
                return;
    }
}

} // namespace visorder::detail
