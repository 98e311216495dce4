#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace visorder {

/// An axis-aligned box, closed. The default one is empty: it holds nothing, and its union with a box is that box.
struct Box {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& point)
    {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void add(const Box& box)
    {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }
    bool meets(const Box& other) const
    {
        return min.x <= other.max.x && other.min.x <= max.x && min.y <= other.max.y && other.min.y <= max.y &&
               min.z <= other.max.z && other.min.z <= max.z;
    }
    /// The middle, also of boxes as large as doubles allow.
    glm::dvec3 middle() const { return min * 0.5 + max * 0.5; }
};

} // namespace visorder
