#pragma once

#include "visorder/renderer.h"

#include <string>

namespace visorder::detail {

/// The part of a fragment shader that stands for an integrator. It defines
///
///     vec4 light_of(float front, float back, float len, vec4 front_optics, vec4 back_optics)
///
/// the light, premultiplied, and opacity of a ray's way through a cell: of length `len`, along which the scalar (0 to 1
/// over the scene) runs from `front` to `back`. Optics are colour and, in w, extinction; only where `needs_optics`.
std::string integrator_shader(Integrator integrator);

/// In place of that, for Integrator::exact where cells come cut into OpticalPasses:
///
///     vec4 light_of_pass(float one, float run, float len, bool swapped)
///
/// of a way along which the scalar runs from `one` to `one + run`, towards the eye if `swapped`.
std::string optical_pass_shader();

/// In place of either, for Integrator::exact where single precision is not enough: reads OpticalPieces from storage
/// buffer 2 and defines
///
///     vec4 light_in_doubles(double front, double back, double len)
///
/// which is right however dense the medium is.
std::string exact_shader_in_doubles();

/// Whether an integrator interpolates colours and extinctions of vertices, so that projectors have to.
bool needs_optics(Integrator integrator);

/// Defines `vec4 optics_at(float scalar)`, for any stage.
std::string optics_shader();

} // namespace visorder::detail
