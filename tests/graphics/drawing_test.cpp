#include "graphics/timer_query.h"
#include "triangle.h"

#include <gtest/gtest.h>

namespace visorder::tests {

using namespace detail;
namespace {

TEST(Drawing, ReadsBackTheRectangleAskedFor)
{
    const Context context;
    const Context::Current current(context);
    constexpr std::array formats{static_cast<GLenum>(GL_RGBA8)};
    const Framebuffer framebuffer(context, {7, 5}, formats, 0);
    Triangle(context).draw(framebuffer, {1, 1, 0, 1});
    const std::vector<std::uint8_t> whole = rgba8(framebuffer);
    std::vector<std::uint8_t> part(static_cast<std::size_t>(3 * 2 * 4));
    framebuffer.read(0, {2, 1}, {3, 2}, GL_RGBA, GL_UNSIGNED_BYTE, part.data());
    for (std::size_t y = 0; y < 2; ++y)
        for (std::size_t x = 0; x < 12; ++x)
            EXPECT_EQ(part[y * 12 + x], whole[(y + 1) * 28 + 8 + x]) << "row " << y << ", byte " << x;
    context.check();
}

TEST(Drawing, DrawsToSeveralImagesAtOnce)
{
    const Context context;
    const Context::Current current(context);
    constexpr std::array formats{static_cast<GLenum>(GL_RGBA32F), static_cast<GLenum>(GL_R32UI)};
    const Framebuffer framebuffer(context, {2, 2}, formats, GL_DEPTH32F_STENCIL8);
    framebuffer.bind();
    constexpr std::array<float, 4> colour{0.25F, 2, -1, 1};
    constexpr std::array<GLuint, 4> item{4'000'000'000U, 0, 0, 0};
    context.gl().ClearBufferfv(GL_COLOR, 0, colour.data());
    context.gl().ClearBufferuiv(GL_COLOR, 1, item.data());
    std::array<float, 4> read_colour{};
    GLuint read_item = 0;
    framebuffer.read(0, {1, 1}, {1, 1}, GL_RGBA, GL_FLOAT, read_colour.data());
    framebuffer.read(1, {0, 1}, {1, 1}, GL_RED_INTEGER, GL_UNSIGNED_INT, &read_item);
    EXPECT_EQ(read_colour, colour);
    EXPECT_EQ(read_item, item[0]);
    context.check();
}

TEST(Drawing, RefusesAUniformThatIsNotThere)
{
    const Context context;
    const Context::Current current(context);
    Program program(context, "empty", {{GL_COMPUTE_SHADER, R"(#version 450 core
layout(local_size_x = 1) in;
void main() {})"}});
    EXPECT_THROW(program.set("misspelt", 1), GraphicsError);
}

TEST(Drawing, TimesTheRenderer)
{
    const Context context;
    const Context::Current current(context);
    constexpr std::array formats{static_cast<GLenum>(GL_RGBA8)};
    const Framebuffer framebuffer(context, {256, 256}, formats, 0);
    Triangle triangle(context);
    TimerQuery timer(context);
    timer.begin();
    for (int i = 0; i < 20; ++i)
        triangle.draw(framebuffer, {1, 1, 0, 1});
    timer.end();
    EXPECT_GT(timer.seconds(), 0);
    context.check();
}

} // namespace
} // namespace visorder::tests
