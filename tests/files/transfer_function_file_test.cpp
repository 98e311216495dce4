#include "files/transfer_function_file.h"
#include "optics/srgb.h"
#include "tests/temporary_folder.h"
#include "visorder/error.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <string>
#include <utility>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TransferFunction read(const std::string& content, const TransferFunctionFileOptions& options = {})
{
    const TemporaryFolder folder;
    return read_transfer_function(folder.write("function.json", content), options);
}

/// What is wrong with a file, in one line that names it; empty if nothing.
std::string fault(const std::string& content, const TransferFunctionFileOptions& options = {})
{
    try {
        read(content, options);
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("function.json: "), Not(HasSubstr("\n"))));
        return error.what();
    }
    return {};
}

std::string own(const std::string& points)
{
    return R"({"points": [)" + points + "]}";
}

std::string paraview(const std::string& entries)
{
    return R"([{"Name": "a map", "RGBPoints": [0, 1, 0, 0, 4, 0, 1, 0])" + entries + "}]";
}

TEST(TransferFunctionFile, ReadsWhatItsFormatSays)
{
    const TransferFunction function = read(own(R"({"scalar": -1, "extinction": 0.5, "colour": [0.1, 0.2, 0.3]},
                                                  {"scalar": 2.5, "extinction": 7, "colour": [1, 0, 1]},
                                                  {"scalar": 2.5, "extinction": 0, "colour": [0, 0, 0]})"));
    ASSERT_EQ(function.points().size(), 3U);
    EXPECT_EQ(function.points()[0].scalar, -1);
    EXPECT_EQ(function.points()[0].extinction, 0.5);
    EXPECT_EQ(function.points()[0].colour, glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(function.points()[1].colour, glm::dvec3(1, 0, 1));
    EXPECT_EQ(function.at(2.5).extinction, 0);
}

TEST(TransferFunctionFile, NamesTheFileAndThePointAtFault)
{
    const std::string good = R"({"scalar": 0, "extinction": 1, "colour": [0, 0, 0]})";
    const auto after_good = [&](const std::string& point) { return fault(own(good + "," + point)); };
    EXPECT_THAT(after_good(R"({"scalar": -1, "extinction": 1, "colour": [0, 0, 0]})"),
                HasSubstr("point 1: scalar -1 is below 0"));
    EXPECT_THAT(after_good(R"({"scalar": 1, "extinction": -1, "colour": [0, 0, 0]})"),
                HasSubstr("point 1: extinction -1"));
    EXPECT_THAT(after_good(R"({"scalar": 1, "extinction": 1, "colour": [0, 0, 2]})"), HasSubstr("point 1: colour"));
    EXPECT_THAT(after_good(R"({"scalar": null, "extinction": 1, "colour": [0, 0, 0]})"),
                HasSubstr("point 1: there is no number \"scalar\""));
    EXPECT_THAT(after_good(R"({"scalar": 1, "colour": [0, 0, 0]})"),
                HasSubstr("point 1: there is no number \"extinction\""));
    EXPECT_THAT(after_good(R"({"scalar": 1, "extinction": 1, "colour": [0, 0]})"), HasSubstr("point 1: there are no"));
    EXPECT_THAT(after_good(R"({"scalar": 1, "extinction": 1, "colour": [0, "a", 0]})"), HasSubstr("point 1: \"a\""));
    EXPECT_THAT(after_good("17"), HasSubstr("point 1: there is no number"));
}

TEST(TransferFunctionFile, RefusesWhatIsNoTransferFunction)
{
    EXPECT_THAT(fault(own(R"({"scalar": NaN, "extinction": 1, "colour": [0, 0, 0]})")), HasSubstr("no JSON"));
    EXPECT_THAT(fault(own(R"({"scalar": 1e999, "extinction": 1, "colour": [0, 0, 0]})")), HasSubstr("no JSON"));
    EXPECT_THAT(fault("{\"points\": [\n"), HasSubstr("no JSON: parse error at line 2"));
    EXPECT_THAT(fault(""), HasSubstr("no JSON"));
    EXPECT_THAT(fault("\xff\xfe"), HasSubstr("no JSON"));
    EXPECT_THAT(fault("3"), HasSubstr("neither"));
    EXPECT_THAT(fault("[]"), HasSubstr("neither"));
    EXPECT_THAT(fault("[3]"), HasSubstr("must be an object"));
    EXPECT_THAT(fault("{}"), HasSubstr("no array \"points\""));
    EXPECT_THAT(fault(own("")), HasSubstr("needs a point"));
    const TemporaryFolder folder;
    EXPECT_THROW(read_transfer_function(folder.file("missing.json")), InputError);
}

TEST(TransferFunctionFile, TurnsParaViewsOpacitiesIntoExtinctionOverTheUnitLength)
{
    const TransferFunction function = read(
        paraview(R"(, "ColorSpace": "RGB", "Points": [0, 0.2, 0.5, 0, 1, 0.2, 0.5, 0, 3, 0.8, 0.5, 0])"), {2.0, ""});
    const auto opacity = [&](double scalar) { return -std::expm1(-function.at(scalar).extinction * 2.0); };
    EXPECT_NEAR(opacity(-5), 0.2, 1e-15);
    EXPECT_NEAR(opacity(0.5), 0.2, 1e-15);
    EXPECT_NEAR(opacity(2), 0.5, 1e-15); // a point of the 16 parts
    for (double scalar = 1; scalar < 3; scalar += 0.01)
        EXPECT_NEAR(opacity(scalar), 0.2 + (scalar - 1) * 0.3, 1e-3);
    EXPECT_NEAR(opacity(9), 0.8, 1e-15);
    EXPECT_EQ(function.at(0).colour, glm::dvec3(1, 0, 0));
    EXPECT_NEAR(function.at(1).colour.r, linear_of_srgb(0.75), 5e-4);
    EXPECT_EQ(function.at(4).colour, glm::dvec3(0, 1, 0));
}

TEST(TransferFunctionFile, MakesParaViewsColoursLinear)
{
    const TransferFunction function = read(R"([{"RGBPoints": [1, 0.5, 0.25, 1]}])");
    EXPECT_EQ(function.at(1).colour, linear_of_srgb(glm::dvec3(0.5, 0.25, 1)));
}

TEST(TransferFunctionFile, SpreadsParaViewsMapsOverAScene)
{
    const char* preset = R"([{"RGBPoints": [0, 1, 0, 0, 0.25, 0, 1, 0, 1, 0, 0, 1],
                              "Points": [0, 0.1, 0.5, 0, 0.5, 0.1, 0.5, 0, 0.5, 0.6, 0.5, 0, 1, 0.6, 0.5, 0]}])";
    const char* from_minus_one = R"([{"RGBPoints": [-1, 1, 0, 0, -0.5, 0, 1, 0, 1, 0, 0, 1],
                              "Points": [-1, 0.1, 0.5, 0, 0, 0.1, 0.5, 0, 0, 0.6, 0.5, 0, 1, 0.6, 0.5, 0]}])";
    const char* of_bytes = R"([{"RGBPoints": [0, 1, 0, 0, 64, 0, 1, 0, 256, 0, 0, 1],
                              "Points": [0, 0.1, 0.5, 0, 128, 0.1, 0.5, 0, 128, 0.6, 0.5, 0, 256, 0.6, 0.5, 0]}])";
    const TransferFunction plain = read(preset);
    for (const char* map : {preset, from_minus_one, of_bytes}) {
        SCOPED_TRACE(map);
        const TransferFunction over_scene = read(map, {1, "", ScalarInterval{-2, 6}});
        for (double position = -0.25; position < 1.25; position += 1.0 / 64) {
            EXPECT_EQ(over_scene.at(-2 + 8 * position).colour, plain.at(position).colour) << position;
            EXPECT_EQ(over_scene.at(-2 + 8 * position).extinction, plain.at(position).extinction) << position;
        }
        EXPECT_EQ(over_scene.points().front().scalar, -2);
        EXPECT_EQ(over_scene.points().back().scalar, 6);

        const TransferFunction constant = read(map, {1, "", ScalarInterval{3, 3}});
        EXPECT_EQ(constant.points().size(), 1U);
        EXPECT_EQ(constant.at(7).colour, glm::dvec3(1, 0, 0));
        EXPECT_THROW(read(map, {1, "", ScalarInterval{3, 2}}), InputError);
    }
}

TEST(TransferFunctionFile, ShowsAConstantByAMapWithoutOpacities)
{
    const TransferFunction constant = read(paraview(""), {2, "", ScalarInterval{3, 3}});
    EXPECT_NEAR(constant.at(3).extinction, -std::log(0.7) / 2, 1e-15);
}

TEST(TransferFunctionFile, TakesScalarsAsTheyStandWithoutASceneAndInItsOwnFormat)
{
    const TransferFunction function = read(paraview(""));
    EXPECT_EQ(function.points().front().scalar, 0);
    EXPECT_EQ(function.points().back().scalar, 4);
    const TransferFunction own_format =
        read(own(R"({"scalar": 0, "extinction": 1, "colour": [0, 0, 0]}, {"scalar": 1, "extinction": 2,
                    "colour": [0, 0, 0]})"),
             {1, "", ScalarInterval{-2, 6}});
    EXPECT_EQ(own_format.points().back().scalar, 1);
}

TEST(TransferFunctionFile, CutsTheRangeIntoParaViewsCategories)
{
    const TransferFunction function =
        read(R"([{"IndexedColors": [1, 0, 0, 0, 1, 0, 0, 0, 1]}])", {2, "", ScalarInterval{-3, 6}});
    const glm::dvec3 red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1);
    for (const auto& [scalar, colour] :
         {std::pair{-9.0, red}, {-3.0, red}, {-0.01, red}, {0.01, green}, {2.99, green}, {3.01, blue}, {8.0, blue}}) {
        EXPECT_EQ(function.at(scalar).colour, colour) << scalar;
        EXPECT_NEAR(function.at(scalar).extinction, -std::log(0.7) / 2, 1e-15);
    }
    // Opacities, of whatever range, go over the same scalars.
    const TransferFunction with_opacities = read(
        R"([{"IndexedColors": [1, 0, 0, 0, 1, 0], "Points": [0, 0.1, 0.5, 0, 50, 0.1, 0.5, 0, 50, 0.6, 0.5, 0, 100, 0.6,
             0.5, 0]}])",
        {1, "", ScalarInterval{0, 8}});
    EXPECT_NEAR(with_opacities.at(3.9).extinction, -std::log(0.9), 1e-15);
    EXPECT_NEAR(with_opacities.at(4.1).extinction, -std::log(0.4), 1e-15);
    EXPECT_EQ(with_opacities.at(3.9).colour, red);
    EXPECT_EQ(with_opacities.at(4.1).colour, green);
}

TEST(TransferFunctionFile, PutsParaViewsCategoriesAroundTheirValues)
{
    const glm::dvec3 red(1, 0, 0), green(0, 1, 0);
    for (const char* annotations : {R"(["2", "two", "10", "ten", "4", "four"])", R"([2, "", 10, "", 4.0, ""])"}) {
        const TransferFunction function =
            read(fmt::format(R"([{{"IndexedColors": [1, 0, 0, 0, 1, 0], "Annotations": {}}}])", annotations),
                 {1, "", ScalarInterval{0, 100}});
        for (const auto& [scalar, colour] :
             {std::pair{0.0, red}, {2.9, red}, {3.1, red}, {6.9, red}, {7.1, green}, {100.0, green}})
            EXPECT_EQ(function.at(scalar).colour, colour) << scalar; // the third takes the first colour again
    }
    const TransferFunction named =
        read(R"([{"IndexedColors": [1, 0, 0, 0, 1, 0], "Annotations": ["steel", "", "2", ""]}])",
             {1, "", ScalarInterval{0, 2}});
    EXPECT_EQ(named.at(0.9).colour, red);
    EXPECT_EQ(named.at(1.1).colour, green);
}

TEST(TransferFunctionFile, TakesCategoriesOfAMapWithBothOnlyIfItSaysSo)
{
    const std::string both = R"(, "IndexedColors": [0, 0, 1])";
    EXPECT_EQ(read(paraview(both)).at(0).colour, glm::dvec3(1, 0, 0));
    EXPECT_EQ(read(paraview(both + R"(, "IndexedLookup": 1)")).at(0).colour, glm::dvec3(0, 0, 1));
}

TEST(TransferFunctionFile, ReadsCommasAtTheEndAndComments)
{
    const std::string map = R"([{"Name": "a, ] b", /* , */ "RGBPoints": [0, 1, 0, 0, 4, 0, 1, 0 , ], // ,
        "NanColor": [1, 0, 0,],},])";
    EXPECT_EQ(read(map).points().back().scalar, 4);
    EXPECT_EQ(colour_map_names(TemporaryFolder().write("map.json", map)), std::vector<std::string>{"a, ] b"});
    for (const char* wrong : {"[,]", "{,}", "[1,,]", "[1,", "[1 /* ,]", R"(["a,])", "[1] // ,\n ,"})
        EXPECT_THAT(fault(wrong), HasSubstr("no JSON")) << wrong;
}

TEST(TransferFunctionFile, KeepsParaViewsJumps)
{
    const TransferFunction function = read(R"([{"RGBPoints": [0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 3, 0, 0, 1],
        "Points": [0, 0.1, 0.5, 0, 2, 0.1, 0.5, 0, 2, 0.6, 0.5, 0]}])");
    EXPECT_EQ(function.at(0.999999).colour, glm::dvec3(1, 0, 0));
    EXPECT_EQ(function.at(1).colour, glm::dvec3(0, 0, 1));
    EXPECT_NEAR(function.at(1.999999).extinction, -std::log(0.9), 1e-14);
    EXPECT_NEAR(function.at(2).extinction, -std::log(0.4), 1e-14);
}

TEST(TransferFunctionFile, LetsOpacityRiseWhereParaViewGivesNone)
{
    const TransferFunction function = read(paraview(""));
    EXPECT_EQ(function.at(0).extinction, 0);
    EXPECT_NEAR(function.at(2).extinction, std::log(2.0), 1e-14);
    EXPECT_NEAR(function.at(4).extinction, -std::log(0.001), 1e-12); // finite, though all is hidden
}

TEST(TransferFunctionFile, TakesOneOfSeveralMapsByItsName)
{
    const std::string maps = R"([{"Name": "a", "RGBPoints": [0, 0, 0, 0]}, {"Name": "b", "RGBPoints": [5, 1, 1, 1]}])";
    EXPECT_EQ(read(maps, {1, "b"}).points().front().scalar, 5);
    EXPECT_THAT(fault(maps), HasSubstr("2 colour maps to choose from: a, b"));
    EXPECT_THAT(fault(maps, {1, "c"}), HasSubstr("no colour map c, only a, b"));
    EXPECT_EQ(read(maps, {1, "", std::nullopt, true}).points().front().scalar, 0);
    EXPECT_EQ(read(maps, {1, "b", std::nullopt, true}).points().front().scalar, 5);
    const TemporaryFolder folder;
    EXPECT_EQ(colour_map_names(folder.write("maps.json", maps)), (std::vector<std::string>{"a", "b"}));
    EXPECT_TRUE(colour_map_names(folder.write("own.json", own(""))).empty());
}

TEST(TransferFunctionFile, RefusesWhatItCannotTakeOfParaView)
{
    EXPECT_THAT(fault(paraview(R"(, "Points": [0, 0, 1.4, 0])")), HasSubstr("Points, point 0: midpoint 1.4"));
    EXPECT_THAT(fault(paraview(R"(, "Points": [0, 0, 0.5, 0, 1, 0, 0.5, -1])")), HasSubstr("Points, point 1: sharp"));
    EXPECT_THAT(fault(paraview(R"(, "Points": [0, 1.5, 0.5, 0])")), HasSubstr("Points, point 0: opacity 1.5"));
    EXPECT_THAT(fault(paraview(R"(, "Points": [1, 0, 0.5, 0, 0, 0, 0.5, 0])")), HasSubstr("Points, point 1: scalar 0"));
    EXPECT_THAT(fault(paraview(R"(, "Points": [1, 0, 0.5])")), HasSubstr("Points must be an array of 4 numbers"));
    EXPECT_THAT(fault(paraview(R"(, "Points": [1, 0, 0.5, "x"])")), HasSubstr("Points, point 0: \"x\""));
    EXPECT_THAT(fault(paraview(R"(, "ColorSpace": "HSL")")), HasSubstr("ColorSpace \"HSL\""));
    EXPECT_THAT(fault(paraview(R"(, "ColorSpace": 3)")), HasSubstr("ColorSpace 3"));
    EXPECT_THAT(fault(paraview(R"(, "UseLogScale": 1)")), HasSubstr("UseLogScale"));
    EXPECT_THAT(fault(R"([{"Name": "a"}])"), HasSubstr("no RGBPoints"));
    EXPECT_THAT(fault(R"([{"IndexedColors": []}])"), HasSubstr("no RGBPoints"));
    EXPECT_THAT(fault(R"([{"IndexedColors": [0, 0]}])"), HasSubstr("IndexedColors must be an array of 3 numbers"));
    EXPECT_THAT(fault(R"([{"IndexedColors": [0, 0, 0, 0, 0, 2]}])"), HasSubstr("IndexedColors, point 1: colour"));
    EXPECT_THAT(fault(R"([{"RGBPoints": [0, 0, 0, -1]}])"), HasSubstr("RGBPoints, point 0: colour"));
    EXPECT_THAT(fault(R"([{"RGBPoints": [0, 0, 0, 0, -1, 0, 0, 0]}])"), HasSubstr("RGBPoints, point 1: scalar -1"));
    EXPECT_EQ(fault(paraview(R"(, "ColorSpace": "Diverging", "UseLogScale": 0, "NanColor": [0, 0, 0])")), "");
    EXPECT_THROW(read(paraview(""), {0, ""}), InputError);
    EXPECT_THROW(read(paraview(""), {std::nan(""), ""}), InputError);
}

} // namespace
} // namespace visorder::tests
