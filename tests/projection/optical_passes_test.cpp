#include "projection/optical_passes.h"

#include "optics/preintegration.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

OpticalPieces pieces_with_jumps_and_a_gap()
{
    return optical_pieces(TransferFunction({{0.1, 0.5, {1, 0, 0}},
                                            {0.3, 4, {0, 1, 0}},
                                            {0.3, 1, {0, 0, 1}},
                                            {0.4, 0, {1, 1, 0}},
                                            {0.6, 0, {0, 1, 1}},
                                            {0.7, 3, {1, 0.5, 0}},
                                            {0.9, 0.2, {0.2, 0.4, 0.6}}}),
                          0, 1);
}

struct Ray {
    double one, run, length; // from Thickness' one side to the other
};

// What a fragment does with a pass, but for the integral, which is the reference's.
glm::dvec4 light_of(const OpticalPieces& pieces, const CellWays& ways, const OpticalPass& pass, const Ray& ray,
                    double& share)
{
    const double one = ray.one - ways.reference;
    const double parts = static_cast<double>(pass.window.z);
    const double part = static_cast<double>(pass.window.w);
    double begin = 0, end = 1;
    if (pass.window.x != pass.window.y) {
        begin = std::clamp((static_cast<double>(pass.window.x) - one) / ray.run * parts - part, 0.0, 1.0);
        end = std::clamp((static_cast<double>(pass.window.y) - one) / ray.run * parts - part, 0.0, 1.0);
    }
    share = std::max(end - begin, 0.0) / parts;
    begin = (begin + part) / parts;
    end = (end + part) / parts;
    if (share <= 0)
        return glm::dvec4(0);
    const double at_begin = ray.one + begin * ray.run;
    const double at_end = ray.one + end * ray.run;
    const double middle = 0.5 * (at_begin + at_end);
    const double extinction =
        static_cast<double>(pass.medium.x) + (middle - ways.reference) * static_cast<double>(pass.rise.x);
    // Windows end at a jump up to rounding: what is left of it beyond has next to no length.
    EXPECT_NEAR(share * extinction, share * mean_extinction(pieces, at_begin, at_end), 4e-6);
    EXPECT_LT(share * ray.length * extinction, 1.001);
    return ways.swapped ? light_along(pieces, at_end, at_begin, share * ray.length)
                        : light_along(pieces, at_begin, at_end, share * ray.length);
}

TEST(OpticalPasses, MakeUpTheWholeWayFarthestFirst)
{
    const OpticalPieces pieces = pieces_with_jumps_and_a_gap();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(0, 1);
    std::vector<OpticalPass> passes;
    for (int i = 0; i < 2000; ++i) {
        SCOPED_TRACE(i);
        const double low = number(random);
        const double high = low + number(random) * (1 - low);
        const bool both = i % 3 == 0;
        const bool rises = i % 2 == 0;
        CellWays ways{low, high, low, 0.1 + number(random), both || rises, both || !rises, i % 5 < 2};
        while (!find_optical_passes(pieces, ways, passes))
            ways.longest *= 0.5;
        ASSERT_GT(ways.longest, 0.02) << low << " " << high;
        for (int k = 0; k < 4; ++k) {
            double one = low + number(random) * (high - low);
            double other = low + number(random) * (high - low);
            if (!both && (other > one) != rises)
                std::swap(one, other);
            const Ray ray{one, other - one, ways.longest * number(random)};
            glm::dvec4 light(0);
            for (const OpticalPass& pass : passes) {
                double share = 0;
                const glm::dvec4 before = light_of(pieces, ways, pass, ray, share);
                light = before + (1 - before.w) * light;
            }
            const glm::dvec4 whole = ways.swapped ? light_along(pieces, other, one, ray.length)
                                                  : light_along(pieces, one, other, ray.length);
            for (int c = 0; c < 4; ++c)
                EXPECT_NEAR(light[c], whole[c], 2e-5);
        }
    }
}

TEST(OpticalPasses, AreNoneWhereNothingIsSeen)
{
    std::vector<OpticalPass> passes;
    const OpticalPieces pieces = pieces_with_jumps_and_a_gap();
    EXPECT_TRUE(find_optical_passes(pieces, {0.45, 0.55, 0.5, 2, true, false, false}, passes));
    EXPECT_TRUE(passes.empty());
    EXPECT_TRUE(find_optical_passes(pieces, {0.45, 0.65, 0.5, 0.1, true, false, false}, passes));
    EXPECT_EQ(passes.size(), 1U);
}

TEST(OpticalPasses, AreLeftToDoublesWhereACellIsTooDense)
{
    std::vector<OpticalPass> passes;
    const OpticalPieces pieces = pieces_with_jumps_and_a_gap();
    for (const double longest : {2.0, 1e3, 1e9, 1e300}) {
        EXPECT_FALSE(find_optical_passes(pieces, {0.2, 0.8, 0.5, longest, true, true, false}, passes)) << longest;
        EXPECT_TRUE(passes.empty());
        EXPECT_TRUE(find_optical_passes(pieces, {0.45, 0.55, 0.5, longest, true, true, false}, passes)) << longest;
    }
}

// The two ends of such a piece may be the same number when they are given relative to a scalar that is far away.
TEST(OpticalPasses, PiecesTooNarrowForSinglePrecisionArePassedOver)
{
    const OpticalPieces pieces = optical_pieces(TransferFunction({{0, 1, glm::dvec3(1, 0, 0)},
                                                                  {0.01, 1, glm::dvec3(1, 0, 0)},
                                                                  {0.01 + 1e-8, 5, glm::dvec3(0, 1, 0)},
                                                                  {1, 5, glm::dvec3(0, 1, 0)}}),
                                                0, 1);
    ASSERT_EQ(pieces.at(0.01).begin, 0.01);
    std::vector<OpticalPass> passes;
    EXPECT_TRUE(find_optical_passes(pieces, {0, 0.9, 0.9, 0.01, true, true, false}, passes));
    ASSERT_FALSE(passes.empty());
    for (const OpticalPass& pass : passes) {
        EXPECT_NE(pass.window.x, pass.window.y);
        EXPECT_LT(std::abs(pass.rise.x), 10);
    }
}

} // namespace
} // namespace visorder::tests
