#pragma once

#include "parallel/large_array.h"
#include "visorder/scene.h"

#include <cstddef>
#include <glm/vec3.hpp>

namespace visorder::detail {

/// The power of a point x with respect to cell i's circumsphere is |x - origin|^2 - 2 dot(centre[i], x - origin) +
/// constant[i]: centres are relative to `origin`, the middle of the scene, and constant = |centre|^2 - radius^2.
///
/// A cell without a circumsphere (flat, or a mixed-element cell whose vertices lie on no one sphere) gets a stand-in
/// around the mean of its vertices, with their mean squared distance for a squared radius.
struct Circumspheres {
    glm::dvec3 origin;
    LargeArray<glm::dvec3> centre;
    LargeArray<double> constant;
    std::size_t stand_ins; ///< how many cells have one
};

/// Throws InputError for a surface scene.
Circumspheres derive_circumspheres(const Scene& scene);

} // namespace visorder::detail
