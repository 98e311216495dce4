#include "geometry/box_hierarchy.h"

#include "geometry/morton_curve.h"
#include "parallel/radix_sort.h"

#include <algorithm>
#include <numeric>

namespace visorder::detail {

BoxHierarchy::BoxHierarchy(std::span<const Box> boxes)
{
    if (boxes.empty())
        return;
    Box all;
    for (const Box& box : boxes)
        all.add(box);
    const MortonCurve curve(all);
    std::vector<std::uint32_t> keys(boxes.size()), numbers(boxes.size()), sorted(boxes.size());
    std::transform(boxes.begin(), boxes.end(), keys.begin(), [&](const Box& box) { return curve.key(box.middle()); });
    std::iota(numbers.begin(), numbers.end(), 0u);
    RadixSort<std::uint32_t>().sort(keys, numbers, sorted);
    items_.reserve(boxes.size());
    for (std::uint32_t i : sorted)
        items_.emplace_back(boxes[i], i);
    nodes_.reserve(boxes.size());
    build(0, static_cast<std::uint32_t>(items_.size()));
}

std::uint32_t BoxHierarchy::build(std::uint32_t begin, std::uint32_t end)
{
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, begin, end, 0});
    Box box;
    if (end - begin <= leaf_size) {
        for (std::uint32_t k = begin; k < end; ++k)
            box.add(items_[k].first);
    } else {
        const std::uint32_t middle = begin + (end - begin) / 2;
        const std::uint32_t left = build(begin, middle);
        const std::uint32_t right = build(middle, end);
        nodes_[index].right = right;
        box.add(nodes_[left].box);
        box.add(nodes_[right].box);
    }
    nodes_[index].box = box;
    return index;
}

} // namespace visorder::detail
