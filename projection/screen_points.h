#pragma once

#include "parallel/large_array.h"
#include "projection/raster_lattice.h"
#include "projection/screen.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace visorder::detail {

/// What a point of a mesh is on the screen. Bits tell on which sides of the image it is; a cell of which all points
/// share one of them is not seen.
namespace sides {
inline constexpr std::uint8_t left = 1, right = 2, below = 4, above = 8, behind = 16;
inline constexpr std::uint8_t all = left | right | below | above | behind;
/// Too far off the image, too close to the plane through the eye or behind it: it has no place on the lattice.
inline constexpr std::uint8_t off_lattice = 32;
} // namespace sides

/// The points of a mesh on the screen, computed once per frame, so that all cells around a point agree on where it is.
struct ScreenPoints {
    LargeArray<glm::dvec3> at;      ///< x, y and depth: see ScreenPoint
    LargeArray<glm::ivec2> snapped; ///< x and y in lattice steps, rounded: to tell at once what covers no pixel
    LargeArray<std::uint8_t> sides;

    /// Reuses memory. All threads; the same result for any number of them.
    void place(const Screen& screen, const RasterLattice& lattice, std::span<const glm::dvec3> points);
};

} // namespace visorder::detail
