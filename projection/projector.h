#pragma once

#include <span>
#include <string_view>

namespace visorder {

/// How a tetrahedron becomes triangles of which every fragment knows where its ray enters and leaves the cell.
enum class Projector {
    silhouette, ///< its outline, one triangle or two; fragments know the thickness as a function of the pixel
    planes,     ///< the same outline; fragments find entry and exit from the planes of the faces
    thick,      ///< three or four triangles around the thickest point (Shirley and Tuchman 1990), with thickness
    thick_gpu   ///< the same triangles, made by the vertex shader
};

/// What the integral of light along a ray through a cell is taken for.
enum class Integrator {
    linear,           ///< colour and opacity interpolated between vertices (Shirley and Tuchman 1990)
    exponential,      ///< opacity of averaged extinction times length, colours of vertices averaged (Stein et al. 1994)
    preintegrated_2d, ///< a table over entry and exit scalar, scaled by length (Roettger et al. 2000, section 4)
    preintegrated_3d, ///< a table over entry and exit scalar and length (Roettger et al. 2000, section 3)
    exact             ///< the integral itself, split at the points of the transfer function
};

const char* name(Projector projector);
const char* name(Integrator integrator);

std::span<const Projector> projectors();
std::span<const Integrator> integrators();

/// By name: silhouette, planes, thick, thick-gpu. Throws InputError for another.
Projector projector_named(std::string_view name);
/// By name: linear, exponential, preintegrated-2d, preintegrated-3d, exact. Throws InputError for another.
Integrator integrator_named(std::string_view name);

} // namespace visorder
