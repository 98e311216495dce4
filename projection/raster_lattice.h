#pragma once

namespace visorder {

class Context;

/// How the rasteriser of OpenGL places vertices: on a lattice within pixels, up to some distance from the image.
struct RasterLattice {
    int steps;      ///< lattice steps a pixel, a power of two
    int half_range; ///< pixels from the image's centre that a vertex may be away, a power of two
};

/// That of a context.
RasterLattice raster_lattice(const Context& context);

} // namespace visorder
