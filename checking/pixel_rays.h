#pragma once

#include "visorder/view.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace visorder::detail {

/// A point in coordinates linear in space in which rays are simple, up to a constant: see PixelRays.
struct SeenPoint {
    double x, y, w;
    double depth; ///< along the view direction, in world units, from the plane through the rays' reference point
};

/// The rays through a view's pixels. A point lies on the ray through (px, py), pixels from the lower left corner of the
/// image, if and only if its offset from that ray is zero:
///
///     x_offset = point.x - px point.w + x_constant(px), y_offset likewise.
///
/// Everything is relative to a reference point amid the scene: from an eye 1e9 scenes away, what is lost to rounding is
/// in the constants, and displaces a ray but not one point against another.
class PixelRays {
public:
    /// Throws InputError for a view with an eye or a matrix that is not finite, a size below 1 by 1, or a matrix that
    /// does not project along straight lines through the eye into an image.
    PixelRays(const View& view, const glm::dvec3& reference);

    SeenPoint seen(const glm::dvec3& point) const;

    double x_constant(double px) const { return constant_.x - px * w_constant_; }
    double y_constant(double py) const { return constant_.y - py * w_constant_; }
    /// A point's whole w: its distance before the plane through a perspective view's eye, scaled, or 1.
    double w(const SeenPoint& point) const { return point.w + w_constant_; }
    /// A point in the image, in pixels, if its w is not zero.
    glm::dvec2 pixel(const SeenPoint& point) const
    {
        return {(point.x + constant_.x) / w(point), (point.y + constant_.y) / w(point)};
    }

    /// Where rays begin: the eye's depth, or minus infinity in a parallel view.
    double first_depth() const { return first_depth_; }
    /// How long the ray through (px, py) is between depths 1 apart.
    double length_per_depth(double px, double py) const;
    /// The depth of the ray through (px, py) at the clip coordinates z = normalised_z * w: -1 on the near plane, 1 on
    /// the far one.
    double depth_at(double px, double py, double normalised_z) const;

private:
    glm::ivec2 size_;
    glm::dvec3 reference_;
    glm::dvec3 x_, y_, w_; // linear forms
    glm::dvec2 constant_;
    double w_constant_;
    glm::dvec3 forward_; // unit
    double first_depth_;
    glm::dmat4 clip_to_world_;
};

} // namespace visorder::detail
