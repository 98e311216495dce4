#pragma once

#include "geometry/exact_predicates.h"
#include "visorder/box.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace visorder::detail {

/// Coordinates in which a scene lies within [-1, 1]: (point - origin) * scale, where the scale is a power of two.
/// Single precision holds planes and eyes in them so well that it nearly always tells their sides.
struct UnitFrame {
    glm::dvec3 origin;
    double scale;

    glm::dvec3 unit(const glm::dvec3& point) const { return (point - origin) * scale; }
};
UnitFrame unit_frame(const Box& bounds);

/// The eye in unit coordinates, rounded, and scaled: its weight is not negative, and its largest component is near 1.
/// All zeros for an eye that doubles cannot hold so: then nothing is known.
glm::dvec4 unit_eye(const UnitFrame& frame, const glm::dvec4& eye);

/// A plane in unit coordinates, positive on the side that sees the points that it was made from counterclockwise. All
/// zeros where single precision cannot stand for it: then nothing is known.
struct UnitPlane {
    float x = 0, y = 0, z = 0, offset = 0;

    UnitPlane operator-() const { return {-x, -y, -z, -offset}; }
    bool known() const { return x != 0 || y != 0 || z != 0; }
};
UnitPlane unit_plane(const UnitFrame& frame, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// An eye in single precision, and what the value x * eye.x + y * eye.y + z * eye.z + offset * eye.w of any plane may
/// be off by.
struct UnitEye {
    float x, y, z, w;
    float bound;

    UnitEye(const UnitFrame& frame, const glm::dvec4& eye);

    /// On which side of a plane the eye lies for sure; `zero` if that is not known.
    Sign sure_side(const UnitPlane& plane) const
    {
        const float value = plane.x * x + plane.y * y + plane.z * z + plane.offset * w;
        return value > bound ? Sign::positive : value < -bound ? Sign::negative : Sign::zero;
    }
};

} // namespace visorder::detail
