#pragma once

namespace visorder::detail {

/// How a rasteriser places vertices: on a lattice within pixels, up to some distance from the image.
struct RasterLattice {
    int steps;      ///< lattice steps per pixel, a power of two
    int half_range; ///< pixels from the image's centre that a vertex may be away, a power of two
};

} // namespace visorder::detail
