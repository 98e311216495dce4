#include "files/plane_points.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

namespace visorder::detail {

namespace {

constexpr std::uint32_t leaf_points = 8;

/// Whether all of a box lies to the right of a line, decided by the corner farthest to the left.
bool lies_right_of(const glm::dvec2& low, const glm::dvec2& high, const glm::dvec2& from, const glm::dvec2& to)
{
    const glm::dvec2 corner(to.y > from.y ? low.x : high.x, to.x > from.x ? high.y : low.y);
    return doubled_area(from, to, corner) < 0;
}

} // namespace

PlanePoints::PlanePoints(const std::vector<glm::dvec2>& points)
    : points_(points), order_(points.size()), leaf_(points.size()), is_there_(points.size(), true)
{
    std::iota(order_.begin(), order_.end(), 0u);
    build(0, static_cast<std::uint32_t>(points.size()), 0);
}

std::uint32_t PlanePoints::build(std::uint32_t begin, std::uint32_t end, std::uint32_t parent)
{
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    Node node{points_[order_[begin]], points_[order_[begin]], begin, end, 0, 0, parent, end - begin};
    for (std::uint32_t i = begin; i < end; ++i) {
        node.low = glm::min(node.low, points_[order_[i]]);
        node.high = glm::max(node.high, points_[order_[i]]);
    }
    nodes_.push_back(node);
    if (end - begin <= leaf_points) {
        for (std::uint32_t i = begin; i < end; ++i)
            leaf_[order_[i]] = index;
        return index;
    }
    const int axis = node.high.x - node.low.x > node.high.y - node.low.y ? 0 : 1;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t p, std::uint32_t q) { return points_[p][axis] < points_[q][axis]; });
    const std::uint32_t left = build(begin, middle, index);
    const std::uint32_t right = build(middle, end, index);
    nodes_[index].left = left;
    nodes_[index].right = right;
    return index;
}

void PlanePoints::remove(std::size_t point)
{
    is_there_[point] = false;
    for (std::uint32_t node = leaf_[point];; node = nodes_[node].parent) {
        --nodes_[node].points;
        if (node == 0)
            return;
    }
}

bool PlanePoints::any_in(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) const
{
    const auto is_in = [&](std::uint32_t point) {
        const glm::dvec2& p = points_[point];
        return is_there_[point] && p != a && p != b && p != c && doubled_area(a, b, p) >= 0 &&
               doubled_area(b, c, p) >= 0 && doubled_area(c, a, p) >= 0;
    };
    const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    std::vector<std::uint32_t> waiting{0};
    while (!waiting.empty()) {
        const Node& node = nodes_[waiting.back()];
        waiting.pop_back();
        if (node.points == 0 || node.low.x > high.x || node.low.y > high.y || node.high.x < low.x ||
            node.high.y < low.y || lies_right_of(node.low, node.high, a, b) ||
            lies_right_of(node.low, node.high, b, c) || lies_right_of(node.low, node.high, c, a))
            continue;
        if (node.left != 0)
            waiting.insert(waiting.end(), {node.left, node.right});
        else if (std::any_of(order_.begin() + node.begin, order_.begin() + node.end, is_in))
            return true;
    }
    return false;
}

} // namespace visorder::detail
