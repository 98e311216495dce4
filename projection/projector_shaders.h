#pragma once

#include "projection/projector.h"

#include <string>

namespace visorder {

/// The vertex and the fragment shader of a program.
struct ShaderPair {
    std::string vertex;
    std::string fragment;
};

/// For what PlaneTriangles, SilhouetteTriangles and ShaderThickTriangles make.
ShaderPair triangle_shaders(Projector projector, Integrator integrator, bool perspective);

/// A rectangle around one NearCell.
ShaderPair near_cell_shaders(Integrator integrator);

} // namespace visorder
