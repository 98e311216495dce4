#pragma once

#include "projection/screen_points.h"
#include "projection/silhouette.h"

#include <cmath>
#include <glm/vec2.hpp>

namespace visorder {

/// Where a cell's first point is, as shaders take it: pixels, in two parts, of which single precision holds the first
/// exactly. That one is made positive, so that its signs can say something else: negative x of a quad, negative y of a
/// cell whose second side is the one in front (see Thickness).
struct PackedPlace {
    glm::vec2 on_lattice;
    glm::vec2 beside;

    /// What is added to make it positive; PLACE_OFFSET in shaders.
    static constexpr int offset = 16384;
};

/// `place` is relative to the image's centre, the result to the pixel corner `centre` before that.
inline PackedPlace packed_place(const glm::dvec2& place, const glm::ivec2& centre, const RasterLattice& lattice,
                                SilhouetteClass kind, bool swapped)
{
    const double steps = lattice.steps;
    const glm::dvec2 on_lattice(std::round(place.x * steps) / steps, std::round(place.y * steps) / steps);
    const glm::vec2 positive(on_lattice + glm::dvec2(centre + PackedPlace::offset));
    return {{kind == SilhouetteClass::quad ? -positive.x : positive.x, swapped ? -positive.y : positive.y},
            glm::vec2(place - on_lattice)};
}

} // namespace visorder
