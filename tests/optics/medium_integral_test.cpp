#include "optics/medium_integral.h"
#include "tests/checking/naive_rays.h"
#include "tests/checking/small_scenes.h"
#include "visorder/error.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

glm::dvec3 random_colour(Random& random)
{
    const double red = random.real(), green = random.real(), blue = random.real();
    return {red, green, blue};
}

std::vector<MediumPoint> random_medium(Random& random, int points, double extinction)
{
    std::vector<MediumPoint> medium;
    double scalar = -1;
    for (int i = 0; i < points; ++i) {
        const bool jump = medium.size() == 1 ||
                          (i > 1 && random.below(3) == 0 && medium[medium.size() - 2].scalar != medium.back().scalar);
        scalar += jump ? 0 : 0.1 + random.real();
        medium.push_back({scalar, random.below(4) == 0 ? 0 : extinction * random.real(), random_colour(random)});
    }
    return medium;
}

// Where one of the medium's points is reached, in [0, 1].
std::vector<double> breaks(const std::vector<MediumPoint>& medium, double first, double last)
{
    std::vector<double> result{0, 1};
    for (const MediumPoint& point : medium)
        if (const double t = (point.scalar - first) / (last - first); t > 0 && t < 1)
            result.push_back(t);
    std::sort(result.begin(), result.end());
    return result;
}

// Between breaks, the trapezoidal rule for the optical depth (exact, as extinction is linear) and Simpson's for light.
Light by_simpson(const std::vector<MediumPoint>& medium, double length, double first, double last)
{
    constexpr int steps = 2000;
    Light light;
    const auto t = breaks(medium, first, last);
    for (std::size_t i = 1; i < t.size(); ++i) {
        const double inset = 1e-12 * (t[i] - t[i - 1]); // keeps off the jumps
        const auto at = [&](int step) {
            const double u = t[i - 1] + inset + (t[i] - t[i - 1] - 2 * inset) * step / steps;
            return naive::medium_at(medium, first + u * (last - first));
        };
        const double h = length * (t[i] - t[i - 1]) / steps;
        const double e0 = at(0).extinction;
        const double rise = (at(steps).extinction - e0) / steps;
        const double before = light.transmittance;
        const auto transmittance = [&](int step) { return before * std::exp(-h * step * (e0 + rise * step / 2.0)); };
        for (int step = 0; step <= steps; ++step) {
            const double weight = step == 0 || step == steps ? 1 : step % 2 == 1 ? 4 : 2;
            light.colour += weight * h / 3 * transmittance(step) * at(step).extinction * at(step).colour;
        }
        light.transmittance = transmittance(steps);
    }
    return light;
}

void expect_near(const Light& a, const Light& b, double tolerance)
{
    EXPECT_NEAR(a.transmittance, b.transmittance, tolerance);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(a.colour[k], b.colour[k], tolerance);
}

TEST(MediumIntegral, IsTheIntegralOfLightToNineDigits)
{
    Random random(1);
    for (const double extinction : {0.01, 0.3, 3.0, 30.0})
        for (int i = 0; i < 40; ++i) {
            const auto medium = random_medium(random, 1 + i % 6, extinction);
            const double first = -2 + 6 * random.real(), last = -2 + 6 * random.real(), length = 2 * random.real();
            SCOPED_TRACE(
                fmt::format("extinction {}, medium {}: from {} to {} along {}", extinction, i, first, last, length));
            Light light;
            MediumIntegral(medium).pass(light, length, first, last);
            expect_near(light, by_simpson(medium, length, first, last), 1e-9);
        }
}

TEST(MediumIntegral, DoesNotDependOnWhereALengthIsCut)
{
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(i);
        const auto medium = random_medium(random, 1 + i % 9, std::pow(10, -3 + 6 * random.real()));
        const MediumIntegral integral(medium);
        const double first = -2 + 6 * random.real(), last = -2 + 6 * random.real(), length = random.real();
        Light whole, parts;
        integral.pass(whole, length, first, last);
        const int pieces = 1 + random.below(20);
        for (int piece = 0; piece < pieces; ++piece)
            integral.pass(parts, length / pieces, std::lerp(first, last, piece * 1.0 / pieces),
                          std::lerp(first, last, (piece + 1.0) / pieces));
        expect_near(whole, parts, 1e-10);
    }
}

TEST(MediumIntegral, IsExponentialWhereTheScalarStays)
{
    const std::vector<MediumPoint> medium{{0, 1, {1, 0, 0}}, {1, 3, {0, 1, 0}}, {1, 5, {0, 0, 1}}, {2, 5, {0, 0, 1}}};
    const MediumIntegral integral(medium);
    Light between, at_jump;
    integral.pass(between, 0.7, 0.5, 0.5);
    expect_near(between, {glm::dvec3(0.5, 0.5, 0) * (1 - std::exp(-1.4)), std::exp(-1.4)}, 1e-15);
    integral.pass(at_jump, 0.7, 1, 1); // what is above holds
    expect_near(at_jump, {glm::dvec3(0, 0, 1) * (1 - std::exp(-3.5)), std::exp(-3.5)}, 1e-15);
}

TEST(MediumIntegral, EndsWhereNothingComesThrough)
{
    for (const double extinction : {1e3, 1e12, 1e300}) {
        SCOPED_TRACE(extinction);
        const MediumIntegral falls(std::vector<MediumPoint>{{0, extinction, {1, 0, 0}}, {1, 0, {0, 1, 0}}});
        Light light;
        falls.pass(light, 1, 0, 1);
        EXPECT_NEAR(light.transmittance, 0, 1e-17);
        EXPECT_NEAR(light.colour.r, 1, 2 / extinction + 1e-14);
        const MediumIntegral rises(std::vector<MediumPoint>{{0, 0, {1, 0, 0}}, {1, extinction, {0, 1, 0}}});
        Light other;
        rises.pass(other, 1, 0, 1);
        EXPECT_NEAR(other.transmittance, 0, 1e-17);
        EXPECT_NEAR(other.colour.r + other.colour.g, 1, 1e-11);
        EXPECT_NEAR(other.colour.g, std::sqrt(std::acos(-1.0) / 2 / extinction), 2 / extinction + 1e-14);
    }
}

TEST(MediumIntegral, RefusesPointsThatMakeNoMedium)
{
    const auto refuses = [](std::vector<MediumPoint> points) {
        EXPECT_THROW(MediumIntegral{std::span<const MediumPoint>(points)}, InputError);
    };
    refuses({});
    refuses({{0, -1, {}}});
    refuses({{0, std::nan(""), {}}});
    refuses({{1, 1, {}}, {0, 1, {}}});
    refuses({{0, 1, {}}, {0, 1, {}}, {0, 1, {}}});
}

} // namespace
} // namespace visorder::tests
