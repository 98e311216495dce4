#pragma once

#include "projection/opengl/renderer.h"
#include "scenes/views.h"
#include "visorder/scene.h"

#include <string>
#include <vector>

namespace visorder::bench {

using namespace detail;

/// How far the transmittance of a medium that is the same everywhere is from what the lengths of rays through the scene
/// say: what is missed, hit twice or taken too long or too short by a projector, and nothing else.
struct TransmittanceErrors {
    double largest = 0;
    glm::ivec2 largest_at{-1}; ///< a pixel with that error
    std::size_t beyond = 0;    ///< pixels that are off by more than `tolerance`
    std::size_t pixels = 0;
};

/// Extinction such that a tenth of the scene's diameter lets 70 % through.
TransferFunction constant_medium(const Scene& scene);

/// Every pixel counts, those on silhouettes too. Where a pixel's centre lies exactly in a plane in which the scene
/// ends, its ray is both inside and outside: what it would be a billionth of a pixel to any side is right there, too.
TransmittanceErrors transmittance_errors(const Scene& scene, const View& view, const Image& drawn, double tolerance);

/// Twenty views: the hard ones, from inside with an angle of 120 degrees, and random ones in perspective and parallel
/// projection.
std::vector<scenes::NamedView> twenty_views(const Scene& scene, glm::ivec2 size);

} // namespace visorder::bench
