#pragma once

#include <cmath>
#include <glm/vec2.hpp>

namespace visorder::detail {

/// Where a cell's first point is, as shaders take it: the middle of the pixel that it is in, which they count others
/// from, made positive, so that the sign of y can say something else: it is negative for a cell whose second side is
/// the one in front (see Thickness).
struct PackedPlace {
    glm::vec2 pixel;
    glm::dvec2 beside; ///< from there to the point

    /// What is added to make it positive; PLACE_OFFSET in shaders.
    static constexpr int offset = 16384;
};

/// `place` is relative to the image's centre, the result to the pixel corner `centre` before that.
inline PackedPlace packed_place(const glm::dvec2& place, const glm::ivec2& centre, bool swapped)
{
    const glm::dvec2 middle(std::floor(place.x) + 0.5, std::floor(place.y) + 0.5);
    const glm::vec2 positive(middle + glm::dvec2(centre + PackedPlace::offset));
    return {{positive.x, swapped ? -positive.y : positive.y}, place - middle};
}

} // namespace visorder::detail
