#include "scene/scalar_interval.h"

#include <algorithm>

namespace visorder {

std::optional<ScalarInterval> scalar_interval(const Mesh& mesh)
{
    if (mesh.scalars.empty())
        return std::nullopt;
    const auto [lowest, highest] = std::minmax_element(mesh.scalars.begin(), mesh.scalars.end());
    return ScalarInterval{*lowest, *highest};
}

} // namespace visorder
