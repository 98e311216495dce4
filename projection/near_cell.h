#pragma once

#include "projection/screen.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace visorder::detail {

/// A tetrahedron for which every pixel finds out by itself, in double precision, whether its ray passes through it: one
/// with a point behind the eye or so close to it, or so far off the image, that it has no place on the rasteriser's
/// lattice; or is too large for it, or one with a face that is not seen well (see VisibleCells), or one so dense that
/// single precision is not enough (see OpticalPass).
///
/// A ray passes a face if it passes all its edges on one side. All cells around an edge have its two points in the same
/// order and so agree, whatever is lost to rounding, on which side that is: no ray slips between two of them. Depths
/// are means of the points' depths with weights of one sign: no cancellation, however flat the cell.
struct NearCell {
    std::array<glm::dvec3, 4> places; ///< x, y, w: the ray through pixel (px, py) has the offset (x - px w, y - py w)
    std::array<glm::dvec2, 4> values; ///< depth, and the scalar times 1 - depth inverse_distance
    /// Way along a ray between depths d and e is that between d / (1 - d inverse_distance) and
    /// e / (1 - e inverse_distance).
    double inverse_distance;
    double first_depth; ///< where rays begin
    glm::dvec2 scalar_range;
    glm::ivec2 low, high; ///< pixels from the image's centre, high excluded: all that it may cover lie between
};

/// A NearCell as shaders read it: places, values, scalar range, first depth, inverse distance, low and high.
using NearCellRecord = std::array<double, 28>;
NearCellRecord record_of(const NearCell& cell);

/// By the points' positions in space, which may be anywhere. Points stand in the order of their numbers in the mesh.
/// None for a cell that covers nothing of the image.
std::optional<NearCell> near_cell(const Screen& screen, const std::array<glm::dvec3, 4>& points,
                                  const std::array<double, 4>& scalars);

/// By where they are on the screen, which must be before the eye: x, y and depth (see ScreenPoint). From an eye that is
/// far away, that is the better of the two.
std::optional<NearCell> near_cell_on_screen(const Screen& screen, const std::array<glm::dvec3, 4>& at,
                                            const std::array<double, 4>& scalars);

} // namespace visorder::detail
