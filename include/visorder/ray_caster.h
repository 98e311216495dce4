#pragma once

#include "visorder/image.h"
#include "visorder/scene.h"
#include "visorder/transfer_function.h"
#include "visorder/view.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder {

struct RayCastOptions {
    /// Whether to leave out what is before the near plane and beyond the far plane of the view's matrix, as OpenGL
    /// does. Else a ray begins at the eye, or, in a parallel view, infinitely far before the scene, and has no end.
    bool clip_near_and_far = false;
    /// Pixels at most this far from a silhouette edge are marked; 0: none are looked for.
    double silhouette_margin = 0;
};

struct RayCast {
    glm::ivec2 size;
    std::vector<glm::dvec4> pixels;            ///< as in Image: linear, premultiplied, from the bottom up
    std::vector<std::uint8_t> near_silhouette; ///< 1 for a marked pixel (see silhouette_pixels), or empty
};

/// What a scene of tetrahedra, filled with a medium that depends on the scalar of its points, looks like: the truth
/// that renderers are measured against, in doubles and without an order of the cells. One ray a pixel, through its
/// centre; along it, every cell it passes through (decided as in cell_crossing.h: none along a positive length is
/// missed), by where it enters them, and the exact integral of light along each (see MediumIntegral), in which the
/// scalar is linear. Alpha is 1 less transmittance.
///
/// Where no cell is, nothing is: cracks are clear. Where cells overlap in space, each is passed whole, as if the one
/// entered later stood behind the other. Cells without volume are not seen.
///
/// Throws InputError, naming the cell or point in the caller's numbering: for cells other than tetrahedra (subdivide
/// the mesh first), for a mesh without scalars or with one that is not finite, a medium that MediumIntegral does not
/// take, a view that PixelRays does not take. On all threads; the result is the same for any number of them.
RayCast cast_rays(const Scene& scene, std::span<const MediumPoint> medium, const View& view,
                  const RayCastOptions& options = {});

/// The same in single precision.
Image image_of(const RayCast& cast);

} // namespace visorder
