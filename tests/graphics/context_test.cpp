#include "graphics/context.h"
#include "triangle.h"
#include "visorder/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <thread>

namespace visorder::tests {

using namespace detail;
namespace {

using testing::HasSubstr;

constexpr std::array rgba{static_cast<GLenum>(GL_RGBA8)};
constexpr glm::vec4 red{1, 0, 0, 1};
constexpr glm::vec4 green{0, 1, 0, 1};

class OnEachPlatform : public testing::TestWithParam<GlPlatform> {};

INSTANTIATE_TEST_SUITE_P(Platforms, OnEachPlatform, testing::Values(GlPlatform::egl, GlPlatform::osmesa),
                         [](const auto& platform) { return std::string(name(platform.param)); });

TEST_P(OnEachPlatform, SaysWhatItIs)
{
    const Context context(GetParam());
    EXPECT_EQ(context.platform(), GetParam());
    EXPECT_FALSE(context.renderer().empty());
    EXPECT_THAT(context.version(), HasSubstr("4."));
    EXPECT_GE(context.largest_size(), 4096);
}

TEST_P(OnEachPlatform, DrawsWithNoWindow)
{
    const Context context(GetParam());
    const Context::Current current(context);
    const Framebuffer framebuffer(context, {8, 8}, rgba, 0);
    Triangle(context).draw(framebuffer, red);
    const std::vector<std::uint8_t> pixels = rgba8(framebuffer);
    EXPECT_EQ(pixels[0], 255) << "red in the lower left corner";
    EXPECT_EQ(pixels[1], 0);
    EXPECT_EQ(pixels[4 * 63], 0) << "black in the upper right corner";
    context.check();
}

TEST_P(OnEachPlatform, ThrowsWhatOpenGlReports)
{
    const Context context(GetParam());
    const Context::Current current(context);
    context.gl().Enable(0x1234);
    try {
        context.check();
        FAIL() << "an invalid enum went unnoticed";
    } catch (const GraphicsError& error) {
        EXPECT_THAT(error.what(), HasSubstr(context.renderer()));
    }
    EXPECT_NO_THROW(context.check()) << "reported once";
}

TEST_P(OnEachPlatform, RefusesShadersThatDoNotCompileWithTheCompilersWords)
{
    const Context context(GetParam());
    const Context::Current current(context);
    const std::size_t before = context.live_objects();
    try {
        const Program program(context, "the title",
                              {{GL_VERTEX_SHADER, "#version 450 core\nvoid main() { nonsense; }"}});
        FAIL() << "nonsense compiled";
    } catch (const GraphicsError& error) {
        EXPECT_THAT(error.what(), HasSubstr("the title"));
        EXPECT_THAT(error.what(), HasSubstr("nonsense"));
    }
    EXPECT_EQ(context.live_objects(), before);
}

TEST_P(OnEachPlatform, RefusesImagesBeyondItsLimits)
{
    const Context context(GetParam());
    const Context::Current current(context);
    for (const glm::ivec2 size : {glm::ivec2(0, 4), glm::ivec2(4, -1), glm::ivec2(context.largest_size() + 1, 4)}) {
        SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
        EXPECT_THROW(Framebuffer(context, size, rgba, 0), InputError);
    }
    EXPECT_EQ(context.live_objects(), 0);
}

TEST_P(OnEachPlatform, LeavesNoObjectsBehind)
{
    const Context context(GetParam());
    {
        const Context::Current current(context);
        Triangle triangle(context);
        const Framebuffer framebuffer(context, {4, 4}, rgba, GL_DEPTH24_STENCIL8);
        triangle.draw(framebuffer, red);
        EXPECT_GE(context.live_objects(), 4);
    }
    EXPECT_EQ(context.live_objects(), 0);
    std::optional<Framebuffer> outlives;
    {
        const Context::Current current(context);
        outlives.emplace(context, glm::ivec2(4, 4), rgba, 0);
    }
    outlives.reset(); // where no context is current
    EXPECT_EQ(context.live_objects(), 0);
}

TEST_P(OnEachPlatform, DrawsOnTwoThreadsAtOnce)
{
    const auto draw_often = [&](glm::vec4 colour, bool& right) {
        const Context context(GetParam());
        const Context::Current current(context);
        Triangle triangle(context);
        const Framebuffer framebuffer(context, {32, 32}, rgba, 0);
        right = true;
        for (int frame = 0; frame < 50; ++frame) {
            triangle.draw(framebuffer, colour);
            const std::vector<std::uint8_t> pixels = rgba8(framebuffer);
            right = right && pixels[0] == 255 * colour.r && pixels[1] == 255 * colour.g;
        }
        context.check();
    };
    bool first = false;
    bool second = false;
    std::thread other(draw_often, red, std::ref(first));
    draw_often(green, second);
    other.join();
    EXPECT_TRUE(first);
    EXPECT_TRUE(second);
}

TEST(Context, BothPlatformsShareAThread)
{
    const Context egl(GlPlatform::egl);
    const Context osmesa(GlPlatform::osmesa);
    const auto draws = [](const Context& context, glm::vec4 colour) {
        const Context::Current current(context);
        const Framebuffer framebuffer(context, {4, 4}, rgba, 0);
        Triangle(context).draw(framebuffer, colour);
        const std::vector<std::uint8_t> pixels = rgba8(framebuffer);
        context.check();
        return pixels[0] == 255 * colour.r && pixels[1] == 255 * colour.g;
    };
    for (int turn = 0; turn < 3; ++turn) {
        EXPECT_TRUE(draws(egl, red));
        EXPECT_TRUE(draws(osmesa, green));
    }
    const Context::Current outer(egl);
    const Framebuffer framebuffer(egl, {4, 4}, rgba, 0);
    Triangle triangle(egl);
    EXPECT_TRUE(draws(osmesa, green)) << "nested in a use of EGL";
    triangle.draw(framebuffer, red);
    EXPECT_EQ(rgba8(framebuffer)[0], 255) << "EGL's is current again";
    egl.check();
}

TEST(Context, MovesBetweenThreads)
{
    const Context context(GlPlatform::egl);
    const auto draw = [&] {
        const Context::Current current(context);
        const Framebuffer framebuffer(context, {4, 4}, rgba, 0);
        Triangle(context).draw(framebuffer, red);
        EXPECT_EQ(rgba8(framebuffer)[0], 255);
        context.check();
    };
    draw();
    std::thread(draw).join();
    draw();
}

TEST(Context, AutomaticIsOneOfThePlatforms)
{
    EXPECT_NE(Context().platform(), GlPlatform::automatic);
}

TEST(Context, KnowsPlatformsByName)
{
    for (GlPlatform platform : {GlPlatform::automatic, GlPlatform::egl, GlPlatform::osmesa})
        EXPECT_EQ(gl_platform(name(platform)), platform);
    EXPECT_THROW(gl_platform("glx"), InputError);
}

} // namespace
} // namespace visorder::tests
