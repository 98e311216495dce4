#pragma once

#include "visorder/mesh.h"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// Which points of a file become one.
struct JoinedPoints {
    std::vector<PointId> number; ///< for each point of the file, its number among those that are left
    std::vector<PointId> kept;   ///< for each of those, the first point of the file that became it
};

/// Joins points with exactly equal coordinates (0.0 and -0.0 are equal) of different pieces. Points of one piece are
/// never joined with each other: where several of a piece are equal, its first joins the first of the other pieces, its
/// second their second, and so on. `pieces` tells where each begins, ascending from 0; none: one piece, of which
/// nothing is joined. Of points that become one the first stays, and points keep their order.
JoinedPoints join_pieces(std::span<const glm::dvec3> points, std::span<const std::size_t> pieces);

/// Joins all points with exactly equal coordinates, or within that distance, as `weld` does.
JoinedPoints join_all(std::span<const glm::dvec3> points, double tolerance = 0);

} // namespace visorder::detail
