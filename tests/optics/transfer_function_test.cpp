#include "optics/srgb.h"
#include "visorder/error.h"
#include "visorder/transfer_function.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <limits>
#include <string>

namespace visorder::tests {

using namespace detail;
namespace {

using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// What is wrong; empty if nothing.
std::string fault(const std::function<void()>& make)
{
    try {
        make();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

std::string fault_of(std::vector<OpticalPoint> points)
{
    return fault([&] { TransferFunction{std::move(points)}; });
}

OpticalPoint grey(double scalar, double extinction)
{
    return {scalar, extinction, {0.5, 0.5, 0.5}};
}

TEST(TransferFunction, IsLinearBetweenPointsAndConstantBeyondThem)
{
    const TransferFunction function({{-1, 2, {0, 1, 0.5}}, {3, 4, {1, 0, 0.5}}, {4, 0, {1, 1, 1}}});
    for (const double below : {-infinity, -1e300, -1.5, -1.0}) {
        EXPECT_EQ(function.at(below).extinction, 2);
        EXPECT_EQ(function.at(below).colour, glm::dvec3(0, 1, 0.5));
        EXPECT_EQ(function.at(below).scalar, below);
    }
    EXPECT_EQ(function.at(0).extinction, 2.5);
    EXPECT_EQ(function.at(0).colour, glm::dvec3(0.25, 0.75, 0.5));
    EXPECT_EQ(function.at(3).extinction, 4);
    EXPECT_EQ(function.at(3.25).extinction, 3);
    for (const double above : {4.0, 4.5, 1e300, infinity}) {
        EXPECT_EQ(function.at(above).extinction, 0);
        EXPECT_EQ(function.at(above).colour, glm::dvec3(1, 1, 1));
    }
}

TEST(TransferFunction, HoldsTheSecondPointAtAJump)
{
    const TransferFunction function(
        {grey(0, 1), grey(0, 2), grey(1, 3), grey(1, 7), grey(2, 7), grey(3, 1), grey(3, 5)});
    EXPECT_EQ(function.at(std::nextafter(0.0, -1.0)).extinction, 1);
    EXPECT_EQ(function.at(0).extinction, 2);
    EXPECT_NEAR(function.at(std::nextafter(1.0, 0.0)).extinction, 3, 1e-15);
    EXPECT_EQ(function.at(1).extinction, 7);
    EXPECT_NEAR(function.at(std::nextafter(3.0, 0.0)).extinction, 1, 1e-14);
    EXPECT_EQ(function.at(3).extinction, 5);
}

TEST(TransferFunction, RefusesPointsThatMakeNoFunctionAndNamesThem)
{
    EXPECT_THAT(fault_of({}), HasSubstr("needs a point"));
    EXPECT_THAT(fault_of({grey(0, 1), grey(-1, 1)}), HasSubstr("point 1: scalar -1 is below 0"));
    EXPECT_THAT(fault_of({grey(0, 1), grey(0, 2), grey(0, 3)}), HasSubstr("point 2: the third at scalar 0"));
    EXPECT_THAT(fault_of({grey(0, 1), grey(1, -0.5)}), HasSubstr("point 1: extinction -0.5"));
    EXPECT_THAT(fault_of({grey(nan, 1)}), HasSubstr("point 0: scalar nan"));
    EXPECT_THAT(fault_of({grey(0, 1), grey(infinity, 1)}), HasSubstr("point 1: scalar inf"));
    EXPECT_THAT(fault_of({grey(0, nan)}), HasSubstr("point 0: extinction nan"));
    EXPECT_THAT(fault_of({grey(0, infinity)}), HasSubstr("point 0: extinction inf"));
    EXPECT_THAT(fault_of({{0, 1, {0, 1.5, 0}}}), HasSubstr("point 0: colour (0, 1.5, 0)"));
    EXPECT_THAT(fault_of({{0, 1, {0, 0, nan}}}), HasSubstr("point 0: colour (0, 0, nan)"));
    EXPECT_THAT(fault_of({grey(-1e308, 1), grey(1e308, 1)}), HasSubstr("too far"));
    EXPECT_EQ(fault_of({grey(0, 0)}), "");
}

TEST(TransferFunction, ExtinctionHidesTheOpacityOverTheLength)
{
    for (const double opacity : {0.0, 1e-12, 0.25, 0.999})
        for (const double length : {1e-3, 1.0, 50.0})
            EXPECT_NEAR(-std::expm1(-extinction_of(opacity, length) * length), opacity, 1e-15);
}

TEST(NamedTransferFunctions, SpanTheRangeAndKeepTheirOpacitiesOverTheUnitLength)
{
    for (const std::string name : transfer_function_names()) {
        SCOPED_TRACE(name);
        const TransferFunction function = named_transfer_function(name, -2, 6, 0.5);
        EXPECT_EQ(function.points().front().scalar, -2);
        if (name != "constant") {
            EXPECT_EQ(function.points().back().scalar, 6);
        }
        const TransferFunction twice_as_far = named_transfer_function(name, -2, 6, 1);
        for (double scalar = -3; scalar < 7; scalar += 0.01) {
            EXPECT_NEAR(twice_as_far.at(scalar).extinction * 2, function.at(scalar).extinction, 1e-14);
            EXPECT_EQ(twice_as_far.at(scalar).colour, function.at(scalar).colour);
        }
    }
}

TEST(NamedTransferFunctions, AreWhatTheirNamesSay)
{
    const auto jumps = [](const TransferFunction& function) {
        const auto points = function.points();
        return std::count_if(points.begin() + 1, points.end(),
                             [](const OpticalPoint& p) { return p.scalar == (&p - 1)->scalar; });
    };
    EXPECT_EQ(jumps(named_transfer_function("steps", 0, 1, 1)), 4);
    EXPECT_EQ(jumps(named_transfer_function("cool-warm", 0, 1, 1)), 0);
    EXPECT_EQ(named_transfer_function("constant", 0, 1, 1).points().size(), 1U);
    const TransferFunction peak = named_transfer_function("narrow-peak", 0, 1, 1);
    EXPECT_GT(peak.at(0.5).extinction, 20 * peak.at(0.485).extinction);
    EXPECT_GT(peak.at(0.5).extinction, 20 * peak.at(1).extinction);
    const TransferFunction in_haze = named_transfer_function("peak-in-haze", 0, 1, 1);
    EXPECT_GT(in_haze.at(0.5).extinction, 2 * in_haze.at(0.505).extinction);
    for (const double beside : {0.0, 0.495, 0.505, 1.0})
        EXPECT_DOUBLE_EQ(in_haze.at(beside).extinction, extinction_of(0.5, 1)) << beside;
    const TransferFunction cool_warm = named_transfer_function("cool-warm", 0, 1, 1);
    EXPECT_GT(cool_warm.at(0).colour.b, cool_warm.at(0).colour.r);
    EXPECT_GT(cool_warm.at(1).colour.r, cool_warm.at(1).colour.b);
    EXPECT_EQ(cool_warm.at(0).extinction, 0);
    const TransferFunction rainbow = named_transfer_function("rainbow", 0, 1, 1);
    for (const OpticalPoint& point : rainbow.points())
        EXPECT_EQ(std::max({point.colour.r, point.colour.g, point.colour.b}), 1);
}

TEST(NamedTransferFunctions, AreConstantOverARangeOfOneScalar)
{
    for (const char* name : transfer_function_names())
        EXPECT_EQ(named_transfer_function(name, 3, 3, 1).points().size(), 1U) << name;
}

TEST(NamedTransferFunctions, RefuseAnUnknownNameAndListTheKnown)
{
    const std::string message = fault([] { named_transfer_function("grey", 0, 1, 1); });
    EXPECT_THAT(message, HasSubstr("grey"));
    for (const char* name : transfer_function_names())
        EXPECT_THAT(message, HasSubstr(name));
    for (const double bad : {nan, infinity, 2.0})
        EXPECT_THAT(fault([&] { named_transfer_function("steps", bad, 1, 1); }), HasSubstr("no range"));
    for (const double bad : {nan, infinity, 0.0, -1.0})
        EXPECT_THAT(fault([&] { named_transfer_function("steps", 0, 1, bad); }), HasSubstr("unit length"));
}

TEST(Srgb, ConversionsAreEachOthersInverse)
{
    for (int i = 0; i <= 1000; ++i)
        EXPECT_NEAR(srgb_of_linear(linear_of_srgb(i / 1000.0)), i / 1000.0, 1e-7);
    EXPECT_NEAR(linear_of_srgb(0.5), 0.21404114, 1e-8); // IEC 61966-2-1
}

} // namespace
} // namespace visorder::tests
