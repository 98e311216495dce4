#include "geometry/exact_predicates.h"

#include <CGAL/Gmpq.h>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace visorder::tests {

using namespace detail;
namespace {

using Rational = CGAL::Gmpq;

// The definition, in rational arithmetic.
Sign reference(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& eye)
{
    Rational p[3], q[3], r[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = Rational(b[k]) - Rational(a[k]);
        q[k] = Rational(c[k]) - Rational(a[k]);
        r[k] = Rational(eye[k]) - Rational(eye.w) * Rational(a[k]);
    }
    Rational sum(0);
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        sum += r[k] * (p[i] * q[j] - p[j] * q[i]);
    }
    const Sign sign = static_cast<Sign>(static_cast<int>(CGAL::sign(sum)));
    return eye.w < 0 ? -sign : sign;
}

std::string words(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec4& e)
{
    char text[512];
    std::snprintf(text, sizeof text, "a %a %a %a  b %a %a %a  c %a %a %a  eye %a %a %a %a", a.x, a.y, a.z, b.x, b.y,
                  b.z, c.x, c.y, c.z, e.x, e.y, e.z, e.w);
    return text;
}

// Inputs that lie on or all but on the plane, at magnitudes from denormal to near the largest double.
class Adversary {
public:
    explicit Adversary(std::uint64_t seed) : engine_(seed) {}

    void next(glm::dvec3& a, glm::dvec3& b, glm::dvec3& c, glm::dvec4& eye)
    {
        const int kind = static_cast<int>(engine_() % 6);
        // Kinds 4 and 5 reach magnitudes whose products underflow or overflow.
        const int exponent = kind == 4 ? -330 : kind == 5 ? 300 : 0;
        a = point(exponent);
        b = point(exponent);
        c = point(exponent);
        if (kind == 1) { // nearly collinear
            const double t = number();
            c = a + t * (b - a);
            nudge(c);
        }
        if (kind == 2) // a lattice, where much is exactly coplanar
            for (glm::dvec3* p : {&a, &b, &c})
                *p = glm::dvec3(engine_() % 4, engine_() % 4, engine_() % 4);
        const double s = number(), t = number();
        glm::dvec3 on_plane = a + s * (b - a) + t * (c - a);
        if (kind == 2)
            on_plane = glm::dvec3(engine_() % 4, engine_() % 4, engine_() % 4);
        else
            nudge(on_plane);
        switch (engine_() % 5) {
        case 0: // along the plane
            eye = glm::dvec4(on_plane - a, 0);
            break;
        case 1: // a weight, also negative, that rounding meets
            eye = glm::dvec4(on_plane * -3.0, -3.0);
            break;
        case 2:
            eye = glm::dvec4(on_plane * 0.1, 0.1);
            break;
        default:
            eye = glm::dvec4(on_plane, 1);
        }
    }

private:
    double number() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; }
    glm::dvec3 point(int exponent)
    {
        const int e = exponent + static_cast<int>(engine_() % 5) * (exponent == 0 ? 1 : 2);
        return {std::ldexp(number(), e * 3), std::ldexp(number(), e * 3), std::ldexp(number(), e * 3)};
    }
    void nudge(glm::dvec3& p)
    {
        for (int k = 0; k < 3; ++k)
            for (auto steps = engine_() % 3; steps > 0; --steps)
                p[k] = std::nextafter(p[k], engine_() % 2 == 0 ? -1e308 : 1e308);
    }

    std::mt19937_64 engine_;
};

bool finite(const glm::dvec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

TEST(SideOfPlane, NeverContradictsRationalArithmeticOnAMillionAdversarialInputs)
{
    Adversary adversary(1);
    int zeros = 0, tested = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        glm::dvec3 a, b, c;
        glm::dvec4 eye;
        adversary.next(a, b, c, eye);
        if (!finite(a) || !finite(b) || !finite(c) || !finite(glm::dvec3(eye)))
            continue;
        ++tested;
        const Sign expected = reference(a, b, c, eye);
        zeros += expected == Sign::zero;
        ASSERT_EQ(side_of_plane(a, b, c, eye), expected) << words(a, b, c, eye);
    }
    EXPECT_GT(tested, 900'000);
    EXPECT_GT(zeros, 10'000) << "the adversary no longer meets the plane";
}

TEST(SideOfPlane, ExactArithmeticAgreesWithRationals)
{
    Adversary adversary(2);
    for (int i = 0; i < 20'000; ++i) {
        glm::dvec3 a, b, c;
        glm::dvec4 eye;
        adversary.next(a, b, c, eye);
        if (!finite(a) || !finite(b) || !finite(c) || !finite(glm::dvec3(eye)))
            continue;
        ASSERT_EQ(side_of_plane_exact(a, b, c, eye), reference(a, b, c, eye)) << words(a, b, c, eye);
    }
}

TEST(SideOfPlane, IsPositiveWhereTheTriangleIsSeenCounterclockwise)
{
    const glm::dvec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    EXPECT_EQ(side_of_plane(a, b, c, glm::dvec3(0, 0, 1)), Sign::positive);
    EXPECT_EQ(side_of_plane(a, b, c, glm::dvec3(0, 0, -1)), Sign::negative);
    EXPECT_EQ(side_of_plane(a, b, c, glm::dvec4(5, 5, 1e-300, 0)), Sign::positive);
    EXPECT_EQ(side_of_plane(a, b, c, glm::dvec4(5, 5, 0, 0)), Sign::zero);
}

TEST(SideOfPlane, TakesTheWeightsSignIntoAccount)
{
    const glm::dvec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
    // (0, 0, -2, -1) is the point (0, 0, 2).
    EXPECT_EQ(side_of_plane(a, b, c, glm::dvec4(0, 0, -2, -1)), Sign::positive);
    EXPECT_EQ(side_of_plane(a, b, c, glm::dvec4(0, 0, 2, -1)), Sign::negative);
}

TEST(InCircumsphere, KnowsInsideOnAndOutside)
{
    const glm::dvec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1);
    EXPECT_EQ(side_of_plane(a, b, c, d), Sign::positive);
    EXPECT_EQ(in_circumsphere(a, b, c, d, {0.5, 0.5, 0.5}), Sign::positive);
    EXPECT_EQ(in_circumsphere(a, b, c, d, {1, 1, 1}), Sign::zero);
    EXPECT_EQ(in_circumsphere(a, b, c, d, {1, 1, std::nextafter(1.0, 2.0)}), Sign::negative);
    EXPECT_EQ(in_circumsphere(a, b, c, d, {1, 1, std::nextafter(1.0, 0.0)}), Sign::positive);
}

} // namespace
} // namespace visorder::tests
