#pragma once

#include "visorder/box.h"

#include <cstdint>

namespace visorder::detail {

/// Morton's space-filling curve through a box, 10 bits an axis: what lies near in space lies near along it.
class MortonCurve {
public:
    explicit MortonCurve(const Box& box);

    /// The place of a point along the curve, in [0, 2^30). A point outside counts as the nearest one inside.
    std::uint32_t key(const glm::dvec3& point) const;

private:
    glm::dvec3 half_min_;
    glm::dvec3 scale_;
};

} // namespace visorder::detail
