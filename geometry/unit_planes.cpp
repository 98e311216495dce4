#include "geometry/unit_planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace visorder::detail {

namespace {

// Single precision stands for a normal whose components are known to 2^-28 of the largest. With that, unit coordinates
// and an eye scaled to a largest component near 1, the error of the filter's value n.e + d w is at most
//   sum |e_i| (2^-25 + 2^-28 [n] + 2^-23.9 [e, rounded twice] + 2^-22 [four roundings of the sum])  <  2^-21 sum |e_i|,
//   |w| (2^-22.8 [d: |d| <= 3, n's error times |point| <= 1 in three components] + 12 2^-24 [sum] + 3 2^-24 [w])
//                                                                                                   <  2^-19 |w|,
// and what underflows is below 2^-140.
constexpr double normal_accuracy = 0x1p-28;

float error_bound(const glm::dvec3& e, double w)
{
    const double bound = 0x1p-21 * (std::abs(e.x) + std::abs(e.y) + std::abs(e.z)) + 0x1p-19 * std::abs(w) + 0x1p-120;
    return std::nextafter(static_cast<float>(bound), std::numeric_limits<float>::infinity());
}

} // namespace

UnitFrame unit_frame(const Box& bounds)
{
    const glm::dvec3 half = bounds.max * 0.5 - bounds.min * 0.5;
    const double radius = std::max({half.x, half.y, half.z});
    // The rounded origin may lie off the middle by an ulp; one power of two more keeps unit coordinates in [-1, 1]. Of
    // a scene so small that the scale would overflow they are smaller.
    constexpr int greatest = std::numeric_limits<double>::max_exponent - 1;
    const double scale = radius > 0 ? std::ldexp(1.0, std::min(-std::ilogb(radius) - 1, greatest)) : 1.0;
    return {bounds.middle(), std::isnormal(scale) ? scale : 1.0};
}

// A positive scale changes no side of a face; a negative weight turns all of them, as the eye's position is then that
// of (-p, -w). What a scale would take out of the range of doubles is left to the exact predicate.
glm::dvec4 unit_eye(const UnitFrame& frame, const glm::dvec4& eye)
{
    constexpr glm::dvec4 unknown(0);
    glm::dvec3 e(eye);
    double w = eye.w;
    if (w != 0 && w != 1) {
        // With a weight in [1, 2) the product with the origin does not underflow.
        const int exponent = -std::ilogb(w);
        for (glm::length_t i = 0; i < 3; ++i)
            e[i] = std::ldexp(eye[i], exponent);
        w = std::ldexp(w, exponent);
        for (glm::length_t i = 0; i < 3; ++i)
            if (std::ldexp(e[i], -exponent) != eye[i])
                return unknown;
        e = {std::fma(-w, frame.origin.x, e.x), std::fma(-w, frame.origin.y, e.y), std::fma(-w, frame.origin.z, e.z)};
    } else if (w == 1) {
        e -= frame.origin;
    }
    e *= frame.scale;
    const double largest = std::max({std::abs(e.x), std::abs(e.y), std::abs(e.z), std::abs(w)});
    // So short a direction, or so long a way, that scaling rounds it.
    if (!(largest >= std::numeric_limits<double>::min() && largest <= std::numeric_limits<double>::max()))
        return unknown;
    const double scale = std::ldexp(w < 0 ? -1.0 : 1.0, -std::ilogb(largest));
    return {e * scale, w * scale};
}

UnitPlane unit_plane(const UnitFrame& frame, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const glm::dvec3 p = (b - a) * frame.scale, q = (c - a) * frame.scale;
    const glm::dvec3 n(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x);
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    const double permanent =
        std::max({std::abs(p.y * q.z) + std::abs(p.z * q.y), std::abs(p.z * q.x) + std::abs(p.x * q.z),
                  std::abs(p.x * q.y) + std::abs(p.y * q.x)});
    // Each of the two products of a component carries three roundings and their difference one more.
    constexpr double u = std::numeric_limits<double>::epsilon() / 2;
    const double error = 5 * u * permanent + std::numeric_limits<double>::min();
    if (!(error <= normal_accuracy / 2 * largest))
        return {};
    const glm::dvec3 unit = n / largest;
    const double offset = -glm::dot(unit, frame.unit(a));
    return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z),
            static_cast<float>(offset)};
}

UnitEye::UnitEye(const UnitFrame& frame, const glm::dvec4& eye)
{
    const glm::dvec4 unit = unit_eye(frame, eye);
    x = static_cast<float>(unit.x);
    y = static_cast<float>(unit.y);
    z = static_cast<float>(unit.z);
    w = static_cast<float>(unit.w);
    bound = error_bound(glm::dvec3(unit), unit.w);
}

} // namespace visorder::detail
