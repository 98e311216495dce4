#include "geometry/exact_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mpzf.h>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace visorder::detail {

namespace {

// Half an ulp of 1: every rounded operation has a relative error of at most this much.
constexpr double u = std::numeric_limits<double>::epsilon() / 2;

Sign sign_of(double x)
{
    return x > 0 ? Sign::positive : x < 0 ? Sign::negative : Sign::zero;
}

// e - w a, each component rounded once.
struct Displacement {
    glm::dvec3 value;
    bool relative; // whether each rounding is relative to the component: nothing has underflowed
};

Displacement from_to(const glm::dvec3& a, const glm::dvec4& eye)
{
    if (eye.w == 1)
        return {glm::dvec3(eye) - a, true}; // a difference does not underflow
    if (eye.w == 0)
        return {glm::dvec3(eye), true};
    const glm::dvec3 d{std::fma(-eye.w, a.x, eye.x), std::fma(-eye.w, a.y, eye.y), std::fma(-eye.w, a.z, eye.z)};
    const auto is_normal = [](double component, double of_a, double of_eye) {
        return std::abs(component) >= std::numeric_limits<double>::min() || (of_a == 0 && of_eye == 0);
    };
    return {d, is_normal(d.x, a.x, eye.x) && is_normal(d.y, a.y, eye.y) && is_normal(d.z, a.z, eye.z)};
}

// The determinant of three vectors whose components carry one rounding each. `certain` is whether its sign is that of
// the determinant of the unrounded vectors: the error is at most (7 + 56 u) u times the permanent (Shewchuk 1997,
// section 4.3), and products that underflow add no more than `underflow`.
struct Determinant {
    double value;
    bool certain;
};

Determinant determinant(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r)
{
    constexpr double relative = (7 + 56 * u) * u;
    const double pxqy = p.x * q.y, pyqx = p.y * q.x;
    const double pyqz = p.y * q.z, pzqy = p.z * q.y;
    const double pzqx = p.z * q.x, pxqz = p.x * q.z;
    const double value = r.z * (pxqy - pyqx) + r.x * (pyqz - pzqy) + r.y * (pzqx - pxqz);
    const double rx = std::abs(r.x), ry = std::abs(r.y), rz = std::abs(r.z);
    const double permanent = (std::abs(pxqy) + std::abs(pyqx)) * rz + (std::abs(pyqz) + std::abs(pzqy)) * rx +
                             (std::abs(pzqx) + std::abs(pxqz)) * ry;
    const double underflow = 1e-300 * (1 + rx + ry + rz);
    // Overflow leaves an infinity or a NaN on the right, and so no certainty.
    return {value, std::abs(value) > relative * permanent + underflow};
}

// Whether each of the six products of the determinant has a factor that is exactly zero. A difference of two doubles
// rounds to zero only if it is zero.
bool all_products_zero(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r)
{
    const auto zero = [](double a, double b, double c) { return a == 0 || b == 0 || c == 0; };
    return zero(p.x, q.y, r.z) && zero(p.y, q.x, r.z) && zero(p.y, q.z, r.x) && zero(p.z, q.y, r.x) &&
           zero(p.z, q.x, r.y) && zero(p.x, q.z, r.y);
}

using Exact = CGAL::Mpzf;

struct ExactVector {
    Exact x, y, z;
};

ExactVector difference(const glm::dvec3& a, const glm::dvec3& b)
{
    return {Exact(a.x) - Exact(b.x), Exact(a.y) - Exact(b.y), Exact(a.z) - Exact(b.z)};
}

Sign side_by_exact_arithmetic(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& eye)
{
    const ExactVector p = difference(b, a);
    const ExactVector q = difference(c, a);
    const Exact w(eye.w);
    const ExactVector r{Exact(eye.x) - w * Exact(a.x), Exact(eye.y) - w * Exact(a.y), Exact(eye.z) - w * Exact(a.z)};
    const Exact value = r.z * (p.x * q.y - p.y * q.x) + r.x * (p.y * q.z - p.z * q.y) + r.y * (p.z * q.x - p.x * q.z);
    return static_cast<Sign>(static_cast<int>(CGAL::sign(value)));
}

Sign sign_of_weight(double w)
{
    return w < 0 ? Sign::negative : Sign::positive;
}

} // namespace

Sign side_of_plane(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& eye)
{
    const glm::dvec3 p = b - a, q = c - a;
    const auto [r, relative] = from_to(a, eye);
    const Determinant filtered = determinant(p, q, r);
    if (filtered.certain && relative)
        return sign_of(filtered.value) * sign_of_weight(eye.w);
    // With an overflowed or fused weight a zero component of r need not be an exact one.
    if ((eye.w == 1 || eye.w == 0) && all_products_zero(p, q, r))
        return Sign::zero;
    return side_of_plane_exact(a, b, c, eye);
}

Sign side_of_plane(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& point)
{
    return side_of_plane(a, b, c, glm::dvec4(point, 1));
}

Sign side_of_plane_exact(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& eye)
{
    return side_by_exact_arithmetic(a, b, c, eye) * sign_of_weight(eye.w);
}

Sign in_circumsphere(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
                     const glm::dvec3& point)
{
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    const auto cgal = [](const glm::dvec3& x) { return Kernel::Point_3(x.x, x.y, x.z); };
    const CGAL::Oriented_side side =
        Kernel().side_of_oriented_sphere_3_object()(cgal(a), cgal(b), cgal(c), cgal(d), cgal(point));
    return static_cast<Sign>(static_cast<int>(side));
}

} // namespace visorder::detail
