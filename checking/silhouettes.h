#pragma once

#include "checking/pixel_rays.h"
#include "visorder/scene.h"

#include <cstdint>
#include <vector>

namespace visorder::detail {

/// Marks (with 1, else 0; rows from the bottom up) the pixels whose centres are at most `margin` pixels from the
/// projection of a silhouette edge: an edge of boundary faces that do not all face the eye, nor all turn away from it.
/// There the length of a ray inside the scene jumps or has an infinite slope, and a picture depends on which of the two
/// sides a pixel's centre is taken to be. Hidden edges count too. Takes tetrahedra.
std::vector<std::uint8_t> silhouette_pixels(const Scene& scene, const View& view, const PixelRays& rays, double margin);

} // namespace visorder::detail
