#pragma once

#include "projection/raster_lattice.h"
#include "projection/screen.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace visorder::detail {

/// A triangle of a surface as one image sees it: where it is drawn, and what decides for each pixel whether the ray
/// through its centre passes through it. The layout is that of `Triangle` in surface_shaders.cpp.
struct SurfaceTriangle {
    std::array<glm::vec2, 3> corners; ///< of what is drawn, in pixels from the image's centre; it may be larger
    /// With (x, y, 1) of a pixel, from the image's centre: not negative of all three where the ray passes through the
    /// triangle. Over their sum, the weights of the corners there.
    std::array<double, 9> edges;
    std::array<float, 3> scalars; ///< of the corners
    std::uint32_t unused;
};
static_assert(sizeof(SurfaceTriangle) == 112);

/// Where the corners of triangles are: x, y, w, so that (x, y) = w (px, py) on the ray through pixel (px, py). Not
/// above 0: w of what is behind the eye.
using SurfacePoint = glm::dvec3;

SurfacePoint surface_point(const Screen& screen, const glm::dvec3& point);

/// Makes triangles of surfaces, all in doubles and in homogeneous coordinates, so that they may reach behind the eye
/// (Olano, Greer 1997, Triangle scan conversion using 2D homogeneous coordinates).
///
/// Two triangles that share an edge have the same numbers for it, but for their signs: an edge is computed from its two
/// ends in one order. And of a pixel that lies on an edge, or on a corner, they decide as if it lay infinitely little
/// to the right and, if that is not enough, up. So no pixel is missed between two triangles, and none counts twice.
///
/// What is drawn is so much larger than the triangle that it holds it wherever rounding to the lattice takes its
/// corners: its sides are moved outwards, or, for triangles that reach behind the eye or are very sharp or very large,
/// it goes around the box of what is seen of it.
class SurfaceTriangles {
public:
    SurfaceTriangles(const Screen& screen, const RasterLattice& lattice);

    /// False, and no triangle, for one that covers no pixel's centre or is seen edge-on.
    bool make(const std::array<SurfacePoint, 3>& corners, SurfaceTriangle& result) const;

private:
    bool draw_enlarged(const std::array<SurfacePoint, 3>& corners, bool turned, SurfaceTriangle& result) const;
    bool draw_box(const std::array<SurfacePoint, 3>& corners, SurfaceTriangle& result) const;
    bool holds_a_pixel(const glm::dvec2& low, const glm::dvec2& high) const;

    glm::dvec2 low_, high_; // the image, in pixels from its centre
    double step_;           // of the lattice, in pixels
    double range_;
};

} // namespace visorder::detail
