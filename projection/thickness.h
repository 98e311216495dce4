#pragma once

#include "projection/scaled_scalars.h"
#include "projection/triangle_sources.h"
#include "projection/visible_cells.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>

namespace visorder::detail {

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
CellValues values_of(const VisibleCell& cell, const ScaledScalars& scalars, double inverse_distance);

ThickPoint thick_point(const VisibleCell& cell, const CellValues& values);

/// Entry and exit of rays through a cell, as functions of two tents t1 and t2, which are linear over pixels and rise
/// from the thickest point to 1 at the silhouette. Of a triangle: one at the side opposite two of the outer points; the
/// third one, t3 = third.x t1 + third.y t2, at the side opposite the outer point that is closest to the inner one, in
/// shares of the area. Of a quad: along its two crossing edges, each 1 at its first end and 0 on the other edge. With
///
///     g = 0,  m = max(t1, t2, t3)     of a triangle,
///     g = max(t2, opposite t2),  m = max(t1, t3)     of a quad, where t3 = third.x t1,
///
/// 1 - g - m is 1 at the thickest point and falls to 0 along the silhouette, linearly on each of Shirley and Tuchman's
/// triangles, and is negative outside. What is linear on the cell's faces, such as a depth, is
///
///     base + along1 t1 + along2 t2 + rise g     on one side,     and that + rise (1 - g - m)     on the other:
///
/// numbers no larger than its values, however narrow the cell. A narrow face is taken for one of
/// VisibleCell::least_width.
struct Thickness {
    struct Linear {
        double base, along1, along2, rise;
    };

    SilhouetteClass kind;
    glm::dvec2 slope1, slope2; ///< of t1 and t2, a pixel
    double first1;             ///< t1 at VisibleCell::points[0], where t2 is 0
    glm::dvec2 third;
    double opposite; ///< of a quad
    Linear depth, scalar;
    bool swapped; ///< whether the second side is the one in front

    /// As shaders take it, (third, opposite, whether it is a triangle):
    /// g = max(t2 - w t2, z t2),  m = max(t1, x t1 + y t2, w t2).
    glm::vec4 shape() const { return {third, opposite, kind == SilhouetteClass::triangle ? 1 : 0}; }

    /// 1 - g - m, at a place in pixels from VisibleCell::points[0].
    double at(const glm::dvec2& r) const;

    /// Of what is linear on the faces, by its values at the cell's points.
    Linear linear(const std::array<double, 4>& values) const;

    /// A quantity given at each of the cell's points, at the thickest point the mean of its values in front and behind
    /// and linear on Shirley and Tuchman's triangles, is
    /// colours[0] + colours[1] t1 + colours[2] t2 + colours[3] g + colours[4] m.
    std::array<glm::vec4, 5> interpolate(const std::array<glm::vec4, 4>& at_points) const;

    // Of a triangle: the outer points whose opposite sides t1, t2 and t3 are 1 at, and their shares at the inner one.
    // Of a quad: where its edges cross, as shares of the way along each.
    std::array<std::uint8_t, 3> outer;
    std::array<double, 3> shares;
    double along_first, along_second;
};

Thickness thickness_of(const VisibleCell& cell, const CellValues& values);

} // namespace visorder::detail
