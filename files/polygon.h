#pragma once

#include "visorder/mesh.h"

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// Splits a polygon of n corners, convex or not, into n - 2 triangles of its orientation by cutting off ears; a convex
/// one becomes a fan around its first corner. The corners of one that is not planar are taken as projected along its
/// mean normal. Coordinates must be finite. A polygon that crosses itself gets some n - 2
/// triangles of its corners. Takes n log n, but where corners crowd within ears that are far longer than wide.
std::vector<std::array<PointId, 3>> triangles_of(std::span<const PointId> polygon, std::span<const glm::dvec3> points);

} // namespace visorder::detail
