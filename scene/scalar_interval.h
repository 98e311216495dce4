#pragma once

#include "visorder/mesh.h"

#include <optional>

namespace visorder::detail {

/// From the lowest finite scalar to the highest.
struct ScalarInterval {
    double lowest, highest;

    double width() const { return highest - lowest; }
};

/// Of all points of a mesh; none if it has no scalars. From 0 to 0 if none of them is finite.
std::optional<ScalarInterval> scalar_interval(const Mesh& mesh);

} // namespace visorder::detail
