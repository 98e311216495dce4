#pragma once

#include "graphics/context.h"
#include "projection/raster_lattice.h"

namespace visorder::detail {

/// That of a context.
RasterLattice raster_lattice(const Context& context);

} // namespace visorder::detail
