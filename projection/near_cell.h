#pragma once

#include "projection/screen.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace visorder {

/// A tetrahedron for which every pixel finds out by itself whether its ray passes through it: one with a point behind
/// the eye or so close to it, or so far off the image, that it has no place on the rasteriser's lattice.
///
/// Each face is the linear inequality offset(x, y) + slope(x, y) d <= 0 over the depth d along the ray through a pixel,
/// with offset and slope linear in the pixel: the dot product of these vectors with (x, y, 1). In a perspective view d
/// is the distance from the plane through the eye, in a parallel one from the plane through Screen::reference.
struct NearCell {
    std::array<glm::vec3, 4> offsets;
    std::array<glm::vec3, 4> slopes;
    glm::vec3 scalar_offset; ///< the scalar is scalar_offset(x, y) + scalar_slope(x, y) d
    glm::vec3 scalar_slope;
    glm::vec2 scalar_range;
    glm::ivec2 low, high; ///< pixels from the image's centre, high excluded: all that it may cover lie between
};

/// None for a flat cell, and for one that covers nothing of the image.
std::optional<NearCell> near_cell(const Screen& screen, const std::array<glm::dvec3, 4>& points,
                                  const std::array<float, 4>& scalars);

} // namespace visorder
