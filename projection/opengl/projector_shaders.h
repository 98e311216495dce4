#pragma once

#include "visorder/renderer.h"

#include <string>

namespace visorder::detail {

/// The vertex and the fragment shader of a program.
struct ShaderPair {
    std::string vertex;
    std::string fragment;
};

/// For what PlaneTriangles, SilhouetteTriangles and ShaderThickTriangles make. `software`: in the form that is quicker
/// where the processor draws, with each channel in an image of its own; the picture is the same.
ShaderPair triangle_shaders(Projector projector, Integrator integrator, bool perspective, bool software);

/// Whether these programs take `half_range` for rows to be interpolated; see outline_of.
bool interpolates_rows(Projector projector, bool software);

/// A rectangle around one NearCell.
ShaderPair near_cell_shaders(Integrator integrator, bool software);

} // namespace visorder::detail
