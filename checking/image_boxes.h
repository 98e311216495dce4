#pragma once

#include "visorder/box.h"
#include "visorder/scene.h"

#include <glm/vec4.hpp>
#include <vector>

namespace visorder::detail {

/// Boxes of cells in an image that an eye sees, for finding pairs of which one may occlude the other: x and y bound the
/// cell's projection, z its distances along the direction of view. Rounding errors are bounded and added, so that
/// projections that share a point have boxes that do, and a cell occludes no other whose box lies nearer. A cell that
/// reaches to the eye's plane or behind it, or whose coordinates over- or underflow, has the box of all space.
///
/// Shares nothing with the charts that the sorters search in.
std::vector<Box> image_boxes(const Scene& scene, const glm::dvec4& eye);

} // namespace visorder::detail
