#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>

namespace visorder::detail {

/// The classes of Shirley and Tuchman 1990 (A polygonal approximation to direct scalar volume rendering), by what the
/// projection of a tetrahedron looks like.
enum class SilhouetteClass : std::uint8_t {
    empty,    ///< no area: all four points on a line
    triangle, ///< class 1: three points around the fourth, which may lie on their border or on one of them
    quad      ///< class 2: two edges that cross
};

/// How four points in the plane lie.
struct Silhouette {
    SilhouetteClass kind = SilhouetteClass::empty;

    /// Of a triangle: the point inside and then the three around it. Of a quad: the ends of one of the edges that cross
    /// and then those of the other. Positions among the four points.
    std::array<std::uint8_t, 4> points{};

    /// For points at depths z (away from the viewer) that make a tetrahedron whose vertices stand in VTK's order:
    /// whether the inner point of a triangle is behind the other three, or the first edge of a quad behind the second.
    bool first_behind = false;

    /// Whether points[1], [2], [3] of a triangle, or points[0], [2], [1], [3] of a quad, stand counterclockwise.
    bool counterclockwise = false;

    /// Of each of `points`, twice the area of the triangle of the other three. Of a triangle, the first is the sum of
    /// the others; of a quad, the first two are together as large as the last two.
    std::array<double, 4> areas{};
};

/// What is degenerate needs no rule of its own: the signs of the four points' affine dependency sum_i s_i p_i = 0,
/// sum_i s_i = 0 tell which of them are inside the hull of which others (Radon 1921). Right for points that are where
/// the given ones are but for rounding.
Silhouette silhouette_of(const std::array<glm::dvec2, 4>& points);

} // namespace visorder::detail
