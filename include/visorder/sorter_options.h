#pragma once

#include "visorder/gl_platform.h"

#include <cstdint>
#include <glm/vec2.hpp>

namespace visorder {

/// Options of `newell`.
struct NewellOptions {
    bool windows = false; ///< whether to keep a list of cells for each of several windows of the image plane
};

/// The rays that `xmpvo` shoots.
enum class XmpvoRays {
    faces,    ///< through every boundary face: its centre and its vertices, pulled in
    crossings ///< those, and through the crossings of projected silhouette edges
};

/// Options of `xmpvo`.
struct XmpvoOptions {
    XmpvoRays rays = XmpvoRays::crossings;
};

/// Options of `bsp-xmpvo`.
struct BspXmpvoOptions {
    std::uint64_t seed = 1; ///< of the samples from which splitting planes are taken
};

/// Options of the sorters that look at an image: `layers`, `layers-blocked`, `layers-compute` and `xmpvo-layered`.
struct LayerOptions {
    glm::ivec2 image_size{0}; ///< in pixels; 0: that of the view
    int block = 64;           ///< of `layers-blocked`: pixels per side of a block
    GlPlatform gl = GlPlatform::automatic;
};

/// Options of all sorters; each reads its own.
struct SorterOptions {
    NewellOptions newell;
    XmpvoOptions xmpvo;
    BspXmpvoOptions bsp_xmpvo;
    LayerOptions layers;
};

} // namespace visorder
