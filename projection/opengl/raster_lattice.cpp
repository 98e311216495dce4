#include "projection/opengl/raster_lattice.h"

#include <algorithm>
#include <bit>

namespace visorder::detail {

RasterLattice raster_lattice(const Context& context)
{
    // Eight bits are enough, and few renderers have more; the range keeps to what is exact in their fixed numbers.
    constexpr int most_bits = 8;
    constexpr unsigned widest = 16384;
    const Context::Current current(context);
    GLint bits = 0;
    context.gl().GetIntegerv(GL_SUBPIXEL_BITS, &bits);
    const unsigned width = std::min(static_cast<unsigned>(context.largest_size()), widest);
    return {1 << std::clamp(bits, 1, most_bits), static_cast<int>(std::bit_floor(width) / 2)};
}

} // namespace visorder::detail
