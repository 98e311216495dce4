// What pictures of the command-line tool show: colour maps, views and surfaces.

#include "files/image_file.h"
#include "tests/apps/run_tool.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;

namespace {

class Pictures : public testing::Test {
protected:
    // What is drawn by `render` with some arguments, and what was said.
    Image drawn(const std::string& arguments)
    {
        const std::string file = folder_.file("picture.exr").string();
        outcome_ = run("render " + arguments + " -o " + file);
        EXPECT_EQ(outcome_.code, 0) << arguments << "\n" << outcome_.output;
        return outcome_.code == 0 ? detail::read_exr(file) : Image{};
    }
    bool says(const std::string& words) const { return outcome_.output.find(words) != std::string::npos; }
    const std::string& said() const { return outcome_.output; }
    std::string write(const std::string& name, const std::string& content)
    {
        return folder_.write(name, content).string();
    }

private:
    TemporaryFolder folder_;
    Outcome outcome_{};
};

std::size_t shown_pixels(const Image& image)
{
    return static_cast<std::size_t>(
        std::count_if(image.pixels.begin(), image.pixels.end(), [](const glm::vec4& pixel) { return pixel.w != 0; }));
}

bool is_blank_around(const Image& image)
{
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x)
            if ((x == 0 || y == 0 || x + 1 == image.size.x || y + 1 == image.size.y) &&
                image.pixels[image.index(x, y)].w != 0)
                return false;
    return true;
}

// How wide and high what is shown is, in pixels.
glm::ivec2 extent(const Image& image)
{
    glm::ivec2 low = image.size, high(-1);
    for (int y = 0; y < image.size.y; ++y)
        for (int x = 0; x < image.size.x; ++x)
            if (image.pixels[image.index(x, y)].w != 0) {
                low = glm::ivec2(std::min(low.x, x), std::min(low.y, y));
                high = glm::ivec2(std::max(high.x, x), std::max(high.y, y));
            }
    return high - low + 1;
}

// A box of two triangles a side, in OFF.
std::string box(double x, double y, double z)
{
    std::string text = "OFF\n8 12 0\n";
    for (int corner = 0; corner < 8; ++corner)
        text += fmt::format("{} {} {}\n", corner % 2 * x, corner / 2 % 2 * y, corner / 4 * z);
    for (const char* side : {"0 1 3 2", "4 5 7 6", "0 1 5 4", "2 3 7 6", "0 2 6 4", "1 3 7 5"}) {
        const std::string s = side;
        text += fmt::format("3 {} {} {}\n3 {} {} {}\n", s[0], s[2], s[4], s[0], s[4], s[6]);
    }
    return text;
}

const std::string maps = R"([
  {"Name": "blues", "ColorSpace": "Lab", "RGBPoints": [-1, 0, 0, 1, 1, 0.1, 0, 0.9], "Points": [-1, 0.5, 0.5, 0, 1, 0.5, 0.5, 0],},
  {"Name": "reds", "ColorSpace": "Step", "RGBPoints": [0, 1, 0, 0, 255, 0.9, 0, 0.1], "Points": [0, 0.5, 0.5, 0, 255, 0.5, 0.5, 0]},
])";

bool is_mostly(const Image& image, int channel)
{
    for (const glm::vec4& pixel : image.pixels)
        for (int other = 0; other < 3; ++other)
            if (other != channel && pixel[other] > 0.2f * pixel[channel])
                return false;
    return shown_pixels(image) > 0;
}

TEST_F(Pictures, TakeTheFirstOfSeveralColourMapsOrTheOneThatIsNamed)
{
    const std::string file = write("maps.json", maps);
    const std::string render = "render --scene delaunay:300 --size 24x24 --transfer ";
    const std::string scene = "--scene delaunay:300 --size 24x24 --transfer " + file;
    EXPECT_TRUE(is_mostly(drawn(scene), 2));
    EXPECT_TRUE(says("holds 2 colour maps: the first, blues, is taken")) << said();
    EXPECT_TRUE(is_mostly(drawn(scene + "@reds"), 0));
    EXPECT_FALSE(says("colour maps")) << said();
    EXPECT_TRUE(is_mostly(drawn(scene + " --map reds"), 0));
    EXPECT_TRUE(is_mostly(drawn(scene + "@blues --map blues"), 2));
    const std::string out = " -o " + write("out.png", "");
    expect_one_line_and_code_2(render + file + "@greens" + out, "no colour map greens, only blues, reds");
    expect_one_line_and_code_2(render + file + "@blues --map reds" + out, "--map reds");
    expect_one_line_and_code_2(render + "nowhere.json@blues" + out, "nowhere.json@blues");
    // The name of a file may have an @ of its own.
    EXPECT_TRUE(is_mostly(drawn("--scene delaunay:300 --size 24x24 --transfer " + write("ma@ps.json", maps)), 2));
    EXPECT_TRUE(
        is_mostly(drawn("--scene delaunay:300 --size 24x24 --transfer " + write("b@c.json", maps) + "@reds"), 0));
}

TEST_F(Pictures, SpreadColourMapsOverTheDataUnlessToldNotTo)
{
    const auto map = [](double from, double to) {
        return fmt::format(R"([{{"RGBPoints": [{}, 0, 0, 1, {}, 1, 0, 0]}}])", from, to);
    };
    const std::string scene = "--scene delaunay:300 --size 24x24 --transfer ";
    const Image unit = drawn(scene + write("unit.json", map(0, 1)));
    const Image signs = drawn(scene + write("signs.json", map(-1, 1)));
    const Image bytes = drawn(scene + write("bytes.json", map(0, 256)));
    for (std::size_t i = 0; i < unit.pixels.size(); ++i)
        for (int k = 0; k < 4; ++k) {
            EXPECT_NEAR(unit.pixels[i][k], signs.pixels[i][k], 1e-6);
            EXPECT_NEAR(unit.pixels[i][k], bytes.pixels[i][k], 1e-6);
        }
    const std::string far_off = write("far.json", map(1e6, 2e6));
    EXPECT_GT(shown_pixels(drawn(scene + far_off)), 0U);
    EXPECT_EQ(shown_pixels(drawn(scene + far_off + " --map-range file")), 0U);
    EXPECT_TRUE(says("cells are visible: the transfer function is transparent")) << said();
}

TEST_F(Pictures, HaveUpWhereTheyAreToldTo)
{
    const std::string tall = write("tall.off", box(1, 1, 8));
    EXPECT_GT(extent(drawn(tall + " --up 0,0,1")).y, 2 * extent(drawn(tall + " --up 0,0,1")).x);
    const glm::ivec2 lying = extent(drawn(tall + " --up 0,1,0 --eye 30,0,4 --size 64x64"));
    const glm::ivec2 standing = extent(drawn(tall + " --up 0,0,1 --eye 30,0,4 --size 64x64"));
    EXPECT_EQ(lying.x, standing.y);
    EXPECT_EQ(lying.y, standing.x);
    const Image up = drawn(tall + " --up 0,0,1 --direction 1,2,0 --size 32x32");
    const Image down = drawn(tall + " --up 0,0,-3e200 --direction 1,2,0 --size 32x32");
    EXPECT_EQ(extent(up), extent(down));
}

TEST_F(Pictures, RefuseAnUpThatIsNone)
{
    const std::string out = " -o " + write("out.png", "");
    const std::string render = "render --scene delaunay:100 ";
    expect_one_line_and_code_2(render + "--direction 0,0,2 --up 0,0,-1" + out, "lies along the view");
    expect_one_line_and_code_2("render " + write("cube.off", box(1, 1, 1)) + " --eye 0.5,9,0.5 --up 0,1e-200,0" + out,
                               "lies along the view");
    expect_one_line_and_code_2(render + "--up 0,0,0" + out, "--up 0,0,0");
    expect_one_line_and_code_2(render + "--up 0,nan,0" + out, "--up");
    expect_one_line_and_code_2(render + "--up 0,1" + out, "--up takes three numbers");
    expect_one_line_and_code_2(render + "--camera 9,9,9,0,0,0,0,1,0 --up 0,0,1" + out, "--up");
    const std::string order = " -o " + write("order.txt", "");
    expect_one_line_and_code_2("sort --scene delaunay:100 --direction 1,0,0 --up 2,0,0" + order, "along the view");
    EXPECT_EQ(run("sort --scene delaunay:100 --direction 1,0,0 --up 0,0,1" + order).code, 0);
    expect_one_line_and_code_2("compare --scene delaunay:100 --up 0,0,0", "--up 0,0,0");
    expect_one_line_and_code_2("layers --scene sphere:80 --up 0,0,0" + order + ".d", "--up 0,0,0");
}

TEST_F(Pictures, HaveZUpWhereASceneIsFlatThatWay)
{
    const auto is_same = [](const Image& a, const Image& b) { return a.pixels == b.pixels; };
    const std::string terrain = write("terrain.off", box(10, 7, 1));
    EXPECT_TRUE(is_same(drawn(terrain), drawn(terrain + " --up 0,0,1")));
    EXPECT_FALSE(is_same(drawn(terrain), drawn(terrain + " --up 0,1,0")));
    // Seen along z, y is up all the same.
    EXPECT_TRUE(is_same(drawn(terrain + " --direction 0,0,1"), drawn(terrain + " --direction 0,0,1 --up 0,1,0")));
    for (const std::string& other :
         {write("cube.off", box(1, 1, 1)), write("wall.off", box(10, 1, 7)), write("bar.off", box(10, 1, 1))})
        EXPECT_TRUE(is_same(drawn(other), drawn(other + " --up 0,1,0"))) << other;
}

TEST_F(Pictures, ShowTheWholeScene)
{
    const std::string bar = write("bar.off", box(10, 1, 2));
    for (const char* size : {"240x120", "120x240"})
        for (const char* view : {"", "--eye 5,0.5,9", "--eye 5,20,1", "--eye -3,4,5", "--eye 5,0.5,4000",
                                 "--direction 1,2,3", "--direction 0,0,1", "--up 1,0,0", "--view-angle 70"}) {
            const Image image = drawn(bar + " " + view + " --size " + size);
            EXPECT_TRUE(is_blank_around(image)) << view << " " << size;
            EXPECT_GT(shown_pixels(image), 15U) << view << " " << size;
        }
    // A view angle that is given is kept.
    EXPECT_FALSE(is_blank_around(drawn(bar + " --eye 5,0.5,9 --view-angle 10 --size 64x64")));
}

TEST_F(Pictures, OfSurfacesAreTranslucent)
{
    const std::string cube = write("cube.off", box(1, 1, 1));
    const auto covered = [](const Image& image, float once) {
        return std::all_of(image.pixels.begin(), image.pixels.end(), [&](const glm::vec4& pixel) {
            return pixel.w == 0 || std::abs(pixel.w - (1 - (1 - once) * (1 - once))) < 1e-6f;
        });
    };
    const Image image = drawn(cube + " --size 80x60");
    EXPECT_GT(shown_pixels(image), 500U);
    EXPECT_TRUE(covered(image, 0.5f));
    EXPECT_TRUE(says("12 of 12 triangles")) << said();
    EXPECT_TRUE(says("in one colour")) << said();
    const Image red = drawn(cube + " --color 1,0,0 --opacity 0.25 --size 80x60");
    EXPECT_TRUE(covered(red, 0.25f));
    EXPECT_TRUE(is_mostly(red, 0));
    EXPECT_EQ(shown_pixels(drawn(cube + " --opacity 0")), 0U);
    EXPECT_TRUE(says("0 of 12 cells are visible: the opacity is 0")) << said();

    drawn("--scene sphere:80 --transfer viridis");
    EXPECT_TRUE(says("coloured by scalars")) << said();
    EXPECT_TRUE(is_mostly(drawn("--scene sphere:80 --color 0,1,0"), 1));
    // Three bars, each over the next one.
    drawn(write("cycle.off", "OFF\n9 3 0\n-3 0.6 -0.5\n3 0.6 0.5\n3 1.2 0.5\n0.98 -2.898 -0.5\n-2.02 2.298 0.5\n"
                             "-2.539 1.998 0.5\n2.02 2.298 -0.5\n-0.98 -2.898 0.5\n-0.461 -3.198 0.5\n"
                             "3 0 1 2\n3 3 4 5\n3 6 7 8\n") +
          " --direction 0,0,1");
    EXPECT_TRUE(says("3 cells occlude each other in 1 cycle:")) << said();

    const std::string out = " -o " + write("out.png", "");
    expect_one_line_and_code_2("render --scene delaunay:100 --opacity 0.5" + out, "--opacity");
    expect_one_line_and_code_2("render --scene sphere:80 --opacity 2" + out, "--opacity");
    expect_one_line_and_code_2("render --scene sphere:80 --color 2,0,0" + out, "--color");
}

TEST_F(Pictures, OfSurfacesShowHowOrdersDiffer)
{
    const std::string results = write("results.json", "");
    const Outcome compared =
        run("compare --scene cards:200 --sorters centroid,newell --views 1 --size 200x200 --json " + results);
    EXPECT_EQ(compared.code, 0) << compared.output;
    std::ifstream file(results);
    const nlohmann::json runs = nlohmann::json::parse(file).at("runs");
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_GT(runs.at(0).at("image_rmse").get<double>(), 0);
    EXPECT_EQ(runs.at(1).at("image_rmse").get<double>(), 0);

    const Outcome in_one_colour =
        run("compare " + write("cube.off", box(1, 1, 1)) + " --sorters centroid,newell --views 1");
    EXPECT_EQ(in_one_colour.code, 0) << in_one_colour.output;
    EXPECT_NE(in_one_colour.output.find("in one colour no order shows"), std::string::npos) << in_one_colour.output;
}

} // namespace
} // namespace visorder::tests
