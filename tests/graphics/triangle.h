#pragma once

#include "graphics/framebuffer.h"
#include "graphics/program.h"

#include <array>
#include <cstdint>
#include <vector>

namespace visorder::tests {

using namespace detail;

/// Draws a triangle over the lower left half of the image, of one colour.
class Triangle {
public:
    explicit Triangle(const Context& context)
        : context_(&context),
          vertices_(context, GlKind::vertex_array),
          program_(context, "triangle",
                   {{GL_VERTEX_SHADER, R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 1 : -1, gl_VertexID == 2 ? 1 : -1, 0, 1); })"},
                    {GL_FRAGMENT_SHADER, R"(#version 450 core
uniform vec4 colour;
out vec4 result;
void main() { result = colour; })"}})
    {
    }

    void draw(const Framebuffer& framebuffer, glm::vec4 colour)
    {
        constexpr std::array<float, 4> black{};
        framebuffer.bind();
        context_->gl().ClearBufferfv(GL_COLOR, 0, black.data());
        program_.set("colour", colour);
        program_.use();
        context_->gl().BindVertexArray(vertices_.id());
        context_->gl().DrawArrays(GL_TRIANGLES, 0, 3);
    }

private:
    const Context* context_;
    GlObject vertices_;
    Program program_;
};

inline std::vector<std::uint8_t> rgba8(const Framebuffer& framebuffer)
{
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(framebuffer.size().x * framebuffer.size().y) * 4);
    framebuffer.read(0, {0, 0}, framebuffer.size(), GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    return pixels;
}

} // namespace visorder::tests
