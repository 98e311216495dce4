#pragma once

#include <glm/vec3.hpp>

namespace visorder::detail {

/// In what a colour map passes from one colour to the next, as VTK and ParaView have it.
enum class ColourSpace {
    rgb,         ///< sRGB as it is stored
    hsv,         ///< hue, saturation and value; hues pass through all that lie between their numbers
    hsv_wrapped, ///< the same, hues the shorter way around the circle
    lab,         ///< CIE L*a*b*
    diverging,   ///< Moreland 2009, Diverging color maps for scientific visualization: white between two saturated hues
    step         ///< not at all: the second colour holds all the way
};

/// The colour a part `t`, in [0, 1], of the way from one colour to another. Colours are sRGB as they are stored, each
/// channel in [0, 1]; the result is so too. The same as vtkColorTransferFunction's, to about 1e-12.
glm::dvec3 between(ColourSpace space, const glm::dvec3& from, const glm::dvec3& to, double t);

} // namespace visorder::detail
