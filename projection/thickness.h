#pragma once

#include "projection/triangle_sources.h"
#include "projection/visible_cells.h"

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace visorder {

/// What a cell is at its thickest point: where its inner point is seen, or where the two edges of a quad cross. Shirley
/// and Tuchman's triangles have it as a corner, and thickness falls from it to zero along the silhouette.
struct ThickPoint {
    glm::dvec2 at;                                   ///< pixels from the image's centre
    double front_depth, back_depth;                  ///< projective, see Screen
    double front_scalar, back_scalar;                ///< each multiplied by 1 - depth / D
    std::array<double, 4> front_shares, back_shares; ///< of the cell's points in its two ends
};

/// The projective depths of a cell's points, and their scalars multiplied by 1 - depth / D: what is linear on the
/// screen. In the order of VisibleCell::points.
struct CellValues {
    std::array<double, 4> depth;
    std::array<double, 4> scalar;
};
CellValues values_of(const VisibleCell& cell, std::span<const float> scalars, double inverse_distance);

ThickPoint thick_point(const VisibleCell& cell, const CellValues& values);

/// The optics of a cell's points and of its thickest point, as the integrators linear and exponential have them: colour
/// averaged between front and back, and averaged extinction or the opacity that comes of it.
struct CellOptics {
    std::array<glm::vec4, 4> at_points;
    glm::vec4 at_thickest;
};
CellOptics optics_of(const TriangleSources& from, const VisibleCell& cell, const ThickPoint& point);

/// Entry and exit of rays through a cell, as functions of the pixel r, relative to VisibleCell::points[0], that take a
/// few multiplications. Let
///
///     t1 = k1.r,  t2 = k2.r,  t3 = k3.r;         g = 0,              m = max(t1, t2, t3)     of a triangle,
///     t1 = 1 + k1.r,  t2 = k2.r,  t3 = k3.x t1;  g = max(t2, k3.y t2),  m = max(t1, t3)      of a quad;
///
/// then 1 - g - m is 1 at the thickest point and falls to 0 along the silhouette, linearly on each of Shirley and
/// Tuchman's triangles, and is negative outside. (Of a quad, t1 and t2 are coordinates along its two crossing edges,
/// from where they cross.) A narrow face is taken for one of VisibleCell::least_width.
/// What is linear on the cell's faces, such as a depth, is
///
///     base + slope.r + rise g     on one side,     and that + rise (1 - g - m)     on the other.
struct Thickness {
    glm::vec2 k1, k2, k3;
    struct Linear {
        glm::vec2 slope;
        float base, rise;
    };
    Linear depth, scalar;
    bool swapped; ///< whether the second side is the one in front

    /// Of what is linear on the faces, by its values at the cell's points.
    Linear linear(const std::array<double, 4>& values) const;

    /// A quantity given at each of the cell's points, and at the thickest point, is
    /// colours[0] + colours[1] r.x + colours[2] r.y + colours[3] g + colours[4] m.
    std::array<glm::vec4, 5> interpolate(const std::array<glm::vec4, 4>& at_points, const glm::vec4& at_thickest) const;

    // Shares of the first two coordinates in an interpolated quantity; see the source.
    SilhouetteClass kind;
    std::array<double, 3> inner_shares; ///< of the three outer points at the inner one
    std::array<glm::dvec2, 3> share_slopes;
    double along_first, along_second; ///< of a quad, where its edges cross, as a share of the way along each
    double opposite1, opposite2;      ///< of a quad, t1 at the second point and t2 at the fourth: below 0
    glm::dvec2 k1_exact, k2_exact;
};

Thickness thickness_of(const VisibleCell& cell, const CellValues& values);

} // namespace visorder
