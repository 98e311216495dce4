#pragma once

#include "visorder/mesh.h"

#include <span>

namespace visorder::detail {

/// The scalars of a mesh's points, shifted and scaled in double precision: 0 to 1 over the scene.
struct ScaledScalars {
    std::span<const float> given;
    double lowest = 0;
    double range = 1; ///< above 0

    double operator[](PointId point) const { return (static_cast<double>(given[point]) - lowest) / range; }
};

} // namespace visorder::detail
