#pragma once

#include "files/polyhedron.h"

namespace visorder::detail {

/// The most points that `convex_hull` takes.
inline constexpr std::size_t max_hull_points = 64;

/// The faces of the convex hull of some of the points, counterclockwise from outside: whole polygons where more than
/// three points lie in a plane, by exact predicates. Points on an edge or inside a face are no corners. No faces if all
/// points lie in one plane. At most `max_hull_points`, with finite coordinates.
PolyhedronFaces convex_hull(std::span<const PointId> some, std::span<const glm::dvec3> points);

} // namespace visorder::detail
