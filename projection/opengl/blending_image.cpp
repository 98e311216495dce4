#include "projection/opengl/blending_image.h"

#include "visorder/error.h"

#include <array>
#include <fmt/format.h>

namespace visorder::detail {

namespace {

// With all channels in one image or each in its own.
std::vector<GLenum> image_formats(int bits, bool apart)
{
    switch (bits) {
    case 32:
        return apart ? std::vector<GLenum>(4, GL_R32F) : std::vector<GLenum>{GL_RGBA32F};
    case 16:
        return apart ? std::vector<GLenum>(4, GL_R16F) : std::vector<GLenum>{GL_RGBA16F};
    case 8:
        return apart ? std::vector<GLenum>(4, GL_R8) : std::vector<GLenum>{GL_RGBA8};
    default:
        throw InputError(fmt::format("blending in {} bits; there are 32, 16 and 8", bits));
    }
}

constexpr const char* result_text = R"(
#ifdef CHANNELS_APART
layout(location = 0) out vec4 red;
layout(location = 1) out vec4 green;
layout(location = 2) out vec4 blue;
layout(location = 3) out vec4 opacity;

void put(vec4 light)
{
    red = light.rrra;
    green = light.ggga;
    blue = light.bbba;
    opacity = light.aaaa;
}
#else
layout(location = 0) out vec4 result;

void put(vec4 light)
{
    result = light;
}
#endif
)";

} // namespace

BlendingImage::BlendingImage(const Context& context, int bits, bool channels_apart)
    : context_(&context), formats_(image_formats(bits, channels_apart))
{
}

void BlendingImage::check_bits(int bits)
{
    image_formats(bits, false);
}

const char* BlendingImage::shader_text()
{
    return result_text;
}

void BlendingImage::start(glm::ivec2 size, glm::ivec2 centre, const RasterLattice& lattice)
{
    const GlFunctions& gl = context_->gl();
    if (!framebuffer_ || framebuffer_->size() != size)
        framebuffer_.emplace(*context_, size, formats_, 0);
    framebuffer_->bind();
    gl.Viewport(centre.x - lattice.half_range, centre.y - lattice.half_range, 2 * lattice.half_range,
                2 * lattice.half_range);
    constexpr std::array<float, 4> clear{};
    for (std::size_t image = 0; image < formats_.size(); ++image)
        gl.ClearBufferfv(GL_COLOR, static_cast<GLint>(image), clear.data());
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_STENCIL_TEST);
    gl.Disable(GL_SCISSOR_TEST);
    gl.Enable(GL_BLEND);
    gl.BlendEquation(GL_FUNC_ADD);
    gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl.ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
}

Image BlendingImage::read() const
{
    const glm::ivec2 size = framebuffer_->size();
    Image image{size, {}};
    image.pixels.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    if (formats_.size() == 1) {
        framebuffer_->read(0, {0, 0}, size, GL_RGBA, GL_FLOAT, image.pixels.data());
        return image;
    }
    std::vector<float> channel(image.pixels.size());
    for (int i = 0; i < 4; ++i) {
        framebuffer_->read(static_cast<std::size_t>(i), {0, 0}, size, GL_RED, GL_FLOAT, channel.data());
        for (std::size_t pixel = 0; pixel < channel.size(); ++pixel)
            image.pixels[pixel][i] = channel[pixel];
    }
    return image;
}

} // namespace visorder::detail
