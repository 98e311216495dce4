#pragma once

#include "visorder/box.h"
#include "visorder/view.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace visorder::detail {

/// A point as it is seen.
struct ScreenPoint {
    double x, y;  ///< pixels from the image's centre, to the right and up
    double depth; ///< projective: see Screen
    double w;     ///< distance before the plane through the eye over that of the farthest point; 1 in a parallel view
};

/// Where the points of a scene are on the screen. All is computed relative to the eye or to a point of the scene, in
/// doubles, so that neither a far scene nor a far eye costs digits.
///
/// The depth z of a point is its distance along the view direction from a plane behind the scene, at distance D from a
/// perspective eye, towards which it is negative. What is plane in space is plane on the screen not over z but over the
/// projective depth
///
///     u = D z / (D + z),    z = u / (1 - u / D),    1 - u / D = D / (D + z) = 1 / w,
///
/// which is z itself where the eye is infinitely far. So u is interpolated linearly in pixels, and any quantity linear
/// in space is so when multiplied by 1 - u / D.
class Screen {
public:
    /// Throws InputError for a view with an eye or a matrix that is not finite, a size below 1 by 1, or a matrix that
    /// is no projection of the space before the eye.
    Screen(const View& view, const Box& bounds);

    ScreenPoint seen(const glm::dvec3& point) const;

    /// A point that may be beside or behind the eye. It is on the ray through pixel (px, py), or, behind the eye, on
    /// its prolongation, if place.x = px place.z and place.y = py place.z.
    struct Anywhere {
        glm::dvec3 place;
        double depth; ///< z, not projective; from the plane through a perspective eye
    };
    Anywhere anywhere(const glm::dvec3& point) const;

    bool perspective() const { return perspective_; }
    glm::ivec2 size() const { return size_; }

    /// The image's centre, a whole pixel corner near it: what ScreenPoint's x and y are relative to.
    glm::ivec2 centre() const { return centre_; }

    /// 1 / D; 0 in a parallel view.
    double inverse_distance() const { return inverse_distance_; }

    /// Distance in the world along the ray through pixel (x, y), per unit of z, is the length of
    /// ray[0] x + ray[1] y + ray[2]. In world coordinates, the columns for x, y and 1.
    const glm::dmat3& rays() const { return rays_; }

    /// That length where it is most in the image.
    double longest_ray() const;

    /// Whether the view shows the world as a mirror does.
    bool mirrors() const { return mirrors_; }

private:
    bool perspective_;
    glm::ivec2 size_;
    glm::ivec2 centre_;
    glm::dvec3 reference_;       // the eye, or the scene's middle
    glm::dvec3 x_, y_;           // linear forms of a point relative to the reference
    glm::dvec2 constant_{0};     // of a parallel view
    glm::dvec3 depth_;           // linear form: z per world unit
    glm::dvec3 depth_reference_; // where z is zero
    double distance_ = 0;        // D
    double inverse_distance_ = 0;
    glm::dmat3 rays_;
    bool mirrors_;
};

} // namespace visorder::detail
