#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace visorder::detail {

/// Twice the signed area of a triangle in the plane, positive if its corners stand counterclockwise.
inline double doubled_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Points in the plane, in a k-d tree, that can be taken away and asked whether one of them lies in a triangle. Takes
/// the logarithm of their number for either, where points and triangles are not stretched out all along each other.
class PlanePoints {
public:
    explicit PlanePoints(const std::vector<glm::dvec2>& points);

    void remove(std::size_t point);

    /// Whether there is a point in the counterclockwise triangle or on its border, other than at its corners.
    bool any_in(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) const;

private:
    struct Node {
        glm::dvec2 low;
        glm::dvec2 high;
        std::uint32_t begin; // in order_
        std::uint32_t end;
        std::uint32_t left; // the next node is the other child; 0 for a leaf
        std::uint32_t right;
        std::uint32_t parent;
        std::uint32_t points; // that are still there
    };

    std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::uint32_t parent);

    const std::vector<glm::dvec2>& points_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> leaf_; // of each point
    std::vector<bool> is_there_;
    std::vector<Node> nodes_;
};

} // namespace visorder::detail
