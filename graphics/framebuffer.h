#pragma once

#include "graphics/gl_object.h"

#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// Images to draw into: colour attachments and, if wanted, depth or depth and stencil, all of one size. Its context
/// must be current where it is made and used.
class Framebuffer {
public:
    /// `colours` are sized internal formats, such as GL_RGBA32F or GL_R32UI, one an attachment; `depth_stencil` is
    /// GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8 or 0. Throws InputError
    /// for a size that is not positive or beyond what the renderer can do, naming it and the limit; GraphicsError
    /// where the formats do not go together.
    Framebuffer(const Context& context, glm::ivec2 size, std::span<const GLenum> colours, GLenum depth_stencil);

    /// Draws go here from now on, the viewport covering all of it.
    void bind() const;

    glm::ivec2 size() const { return size_; }
    GLuint id() const { return framebuffer_.id(); }
    GLuint colour(std::size_t attachment = 0) const { return colours_[attachment].id(); }
    GLuint depth_stencil() const { return depth_stencil_.id(); }

    /// Reads a rectangle of a colour attachment, rows from the bottom up and tightly packed; `into` must hold it.
    void read(std::size_t attachment, glm::ivec2 from, glm::ivec2 size, GLenum format, GLenum type, void* into) const;

private:
    const Context* context_;
    glm::ivec2 size_;
    GlObject framebuffer_;
    std::vector<GlObject> colours_;
    GlObject depth_stencil_;
};

} // namespace visorder::detail
