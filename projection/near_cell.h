#pragma once

#include "projection/screen.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace visorder {

/// A tetrahedron for which every pixel finds out by itself, in double precision, whether its ray passes through it: one
/// with a point behind the eye or so close to it, or so far off the image, that it has no place on the rasteriser's
/// lattice; or one with a face that single precision does not see well (see VisibleCells).
///
/// Each face is the linear inequality offset(x, y) + slope(x, y) d <= 0 over the depth d along the ray through a pixel,
/// with offset and slope linear in the pixel: the dot product of these vectors with (x, y, 1). The two cells at a face
/// have the same but for the sign, so that they agree, whatever is lost to rounding, about a ray in the face's plane.
struct NearCell {
    std::array<glm::dvec3, 4> offsets;
    std::array<glm::dvec3, 4> slopes;
    /// The scalar is (scalar_offset(x, y) + scalar_slope(x, y) d) / (1 - d inverse_distance), and way along the ray
    /// between depths d and e is that between d / (1 - d inverse_distance) and e / (1 - e inverse_distance).
    glm::dvec3 scalar_offset;
    glm::dvec3 scalar_slope;
    double inverse_distance;
    double first_depth; ///< where rays begin
    glm::vec2 scalar_range;
    glm::ivec2 low, high; ///< pixels from the image's centre, high excluded: all that it may cover lie between
};

/// By the points' positions in space, which may be anywhere: d is the distance from the plane through the eye, in a
/// parallel view from that through Screen::reference. Points stand in the order of their numbers in the mesh. None for
/// a flat cell, and for one that covers nothing of the image.
std::optional<NearCell> near_cell(const Screen& screen, const std::array<glm::dvec3, 4>& points,
                                  const std::array<float, 4>& scalars);

/// By where they are on the screen, which must be before the eye (see ScreenPoint): d is the projective depth. From an
/// eye that is far away, that is the better of the two.
std::optional<NearCell> near_cell_on_screen(const Screen& screen, const std::array<glm::dvec3, 4>& at,
                                            const std::array<float, 4>& scalars);

} // namespace visorder
