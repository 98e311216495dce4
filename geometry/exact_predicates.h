#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace visorder::detail {

enum class Sign : int { negative = -1, zero = 0, positive = 1 };

constexpr Sign operator-(Sign s)
{
    return static_cast<Sign>(-static_cast<int>(s));
}
constexpr Sign operator*(Sign a, Sign b)
{
    return static_cast<Sign>(static_cast<int>(a) * static_cast<int>(b));
}

/// On which side of the plane through a, b and c the eye lies: `positive` where it sees a, b, c counterclockwise,
/// `zero` in the plane (always, for collinear points). The eye is homogeneous: a position (p, w), w of either sign, or
/// with w = 0 a direction, whose side is that of the points far along it.
///
/// Exact for all finite input: a floating-point filter with a proved error bound (after Shewchuk 1997, Adaptive
/// precision floating-point arithmetic, section 4.3), then the signs of zero products, then exact arithmetic.
Sign side_of_plane(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& eye);

/// The same for a point.
Sign side_of_plane(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& point);

/// The same by exact arithmetic alone, for tests.
Sign side_of_plane_exact(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& eye);

/// `positive` where `point` lies strictly inside the sphere through a, b, c and d, which are positively oriented
/// (side_of_plane(a, b, c, d) is positive: VTK's order), `zero` on it. Exact.
Sign in_circumsphere(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
                     const glm::dvec3& point);

} // namespace visorder::detail
