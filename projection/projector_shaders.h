#pragma once

#include "projection/projector.h"

#include <string>

namespace visorder {

/// The vertex and the fragment shader of a program.
struct ShaderPair {
    std::string vertex;
    std::string fragment;
};

/// Triangles of TriangleRecords, whose fragments find their ray's entry and exit on the faces.
ShaderPair planes_shaders(Integrator integrator);

/// A rectangle around one NearCell.
ShaderPair near_cell_shaders(Integrator integrator);

} // namespace visorder
