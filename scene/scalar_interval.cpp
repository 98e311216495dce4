#include "scene/scalar_interval.h"

#include <algorithm>
#include <cmath>

namespace visorder::detail {

std::optional<ScalarInterval> scalar_interval(const Mesh& mesh)
{
    if (mesh.scalars.empty())
        return std::nullopt;
    std::optional<ScalarInterval> interval;
    for (const float scalar : mesh.scalars)
        if (std::isfinite(scalar)) {
            if (!interval)
                interval = {scalar, scalar};
            interval->lowest = std::min<double>(interval->lowest, scalar);
            interval->highest = std::max<double>(interval->highest, scalar);
        }
    return interval ? interval : ScalarInterval{0, 0};
}

} // namespace visorder::detail
