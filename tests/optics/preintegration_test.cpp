#include "optics/preintegration.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace visorder::tests {

using namespace detail;
namespace {

const TransferFunction with_jumps(
    {{0.1, 0.5, {1, 0, 0}}, {0.4, 3, {0, 1, 0}}, {0.4, 0.2, {0, 0, 1}}, {0.6, 8, {1, 1, 0}}, {0.7, 0, {0, 0, 0}}});

// By many thin layers.
glm::dvec4 by_layers(double front, double back, double length)
{
    constexpr int layers = 200000;
    glm::dvec3 light(0);
    double transmittance = 1;
    for (int i = 0; i < layers; ++i) {
        const OpticalPoint p = with_jumps.at(front + (back - front) * (i + 0.5) / layers);
        const double passed = std::exp(-p.extinction * length / layers);
        light += transmittance * (1 - passed) * p.colour;
        transmittance *= passed;
    }
    return {light, 1 - transmittance};
}

TEST(Preintegration, IsTheIntegral)
{
    const OpticalPieces pieces = optical_pieces(with_jumps, 0, 1);
    for (const double front : {0.0, 0.3, 0.65, 1.0})
        for (const double back : {0.0, 0.35, 0.55, 0.65, 1.0})
            for (const double length : {0.01, 1.0, 40.0}) {
                const glm::dvec4 got = light_along(pieces, front, back, length);
                const glm::dvec4 wanted = by_layers(front, back, length);
                for (int k = 0; k < 4; ++k)
                    EXPECT_NEAR(got[k], wanted[k], 2e-4) << front << " to " << back << " along " << length;
                EXPECT_NEAR(-std::expm1(-mean_extinction(pieces, front, back) * length), got.w, 1e-6);
            }
}

TEST(Preintegration, IsRightWhereAPartOfTheWayIsDense)
{
    // A flank, rising from nothing over a hundredth of the way, behind which nothing is seen.
    for (const double extinction : {1e2, 1e5, 1e9}) {
        const OpticalPieces pieces =
            optical_pieces(TransferFunction({{0.5, 0, {1, 0, 0}}, {0.51, extinction, {0, 1, 0}}}), 0, 1);
        const glm::dvec4 light = light_along(pieces, 0, 1, 1);
        // Of colour 1 - x, at optical depth k x^2 / 2 in parts of the flank, the mean is that of exp(-t) over the way.
        const double k = extinction * 0.01;
        const double root = std::sqrt(k / 2);
        const double mean = std::sqrt(3.14159265358979323846) / (2 * root) * std::erf(root);
        EXPECT_NEAR(light.x, 1 - mean, 1e-6) << extinction;
        EXPECT_NEAR(light.w, 1, 1e-9) << extinction;
    }
}

TEST(Preintegration, TablesHoldTheIntegralAtTheirEntries)
{
    const OpticalPieces pieces = optical_pieces(with_jumps, -1, 3);
    constexpr std::size_t size = 9;
    const std::vector<glm::vec4> plane = preintegrated_2d(pieces, size, 0.5);
    for (const bool exponential : {false, true}) {
        const LengthAxis axis = length_axis(5, 2, exponential);
        EXPECT_EQ(axis.lengths.front(), 0);
        EXPECT_TRUE(std::is_sorted(axis.lengths.begin(), axis.lengths.end()));
        EXPECT_NEAR(axis.lengths[exponential ? 3 : 4], 2, 1e-12);
        const std::vector<glm::vec4> solid = preintegrated_3d(pieces, size, axis.lengths);
        for (std::size_t front = 0; front < size; ++front)
            for (std::size_t back = 0; back < size; ++back) {
                const double s0 = static_cast<double>(front) / (size - 1);
                const double s1 = static_cast<double>(back) / (size - 1);
                EXPECT_NEAR(plane[back * size + front].w, light_along(pieces, s0, s1, 0.5).w, 1e-6);
                for (std::size_t k = 1; k < 4; ++k) {
                    const glm::vec4 density = solid[(k * size + back) * size + front];
                    const glm::dvec4 wanted = light_along(pieces, s0, s1, axis.lengths[k]);
                    EXPECT_NEAR(density.x * axis.lengths[k], wanted.x, 1e-5);
                    EXPECT_NEAR(-std::expm1(-density.w * axis.lengths[k]), wanted.w, 1e-5);
                }
            }
    }
}

TEST(OpticalPieces, AreTheTransferFunction)
{
    const OpticalPieces pieces = optical_pieces(with_jumps, 0, 1);
    for (int i = -20; i < 120; ++i) {
        const double s = i / 100.0 + 0.0003;
        const auto& piece = pieces.at(s);
        EXPECT_LE(piece.begin, s);
        EXPECT_LT(s, piece.end);
        const OpticalPoint wanted = with_jumps.at(s);
        EXPECT_NEAR(piece.extinction + (s - piece.begin) * piece.extinction_slope, wanted.extinction, 1e-12);
        EXPECT_NEAR(static_cast<double>(piece.colour.x) + (s - piece.begin) * static_cast<double>(piece.colour_slope.x),
                    wanted.colour.x, 1e-6);
    }
}

} // namespace
} // namespace visorder::tests
