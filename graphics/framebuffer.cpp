#include "graphics/framebuffer.h"

#include "visorder/error.h"

#include <algorithm>
#include <fmt/format.h>

namespace visorder::detail {

namespace {

bool has_stencil(GLenum format)
{
    return format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
}

} // namespace

Framebuffer::Framebuffer(const Context& context, glm::ivec2 size, std::span<const GLenum> colours, GLenum depth_stencil)
    : context_(&context), size_(size)
{
    if (size.x < 1 || size.y < 1 || std::max(size.x, size.y) > context.largest_size())
        throw InputError(fmt::format("an image of {} x {} pixels cannot be drawn: 1 to {} a side on {}", size.x, size.y,
                                     context.largest_size(), context.renderer()));
    const GlFunctions& gl = context.gl();
    framebuffer_ = GlObject(context, GlKind::framebuffer);
    std::vector<GLenum> attachments;
    for (const GLenum format : colours) {
        const GlObject& texture = colours_.emplace_back(context, GlKind::texture, GL_TEXTURE_2D);
        gl.TextureStorage2D(texture.id(), 1, format, size.x, size.y);
        attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
        gl.NamedFramebufferTexture(framebuffer_.id(), attachments.back(), texture.id(), 0);
    }
    if (depth_stencil != 0) {
        depth_stencil_ = GlObject(context, GlKind::texture, GL_TEXTURE_2D);
        gl.TextureStorage2D(depth_stencil_.id(), 1, depth_stencil, size.x, size.y);
        gl.NamedFramebufferTexture(framebuffer_.id(),
                                   has_stencil(depth_stencil) ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT,
                                   depth_stencil_.id(), 0);
    }
    gl.NamedFramebufferDrawBuffers(framebuffer_.id(), static_cast<GLsizei>(attachments.size()), attachments.data());
    context.check();
    if (const GLenum status = gl.CheckNamedFramebufferStatus(framebuffer_.id(), GL_FRAMEBUFFER);
        status != GL_FRAMEBUFFER_COMPLETE)
        throw GraphicsError(
            fmt::format("OpenGL ({}): these formats do not make a framebuffer ({:#x})", context.renderer(), status));
}

void Framebuffer::bind() const
{
    context_->gl().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    context_->gl().Viewport(0, 0, size_.x, size_.y);
}

void Framebuffer::read(std::size_t attachment, glm::ivec2 from, glm::ivec2 size, GLenum format, GLenum type,
                       void* into) const
{
    const GlFunctions& gl = context_->gl();
    gl.NamedFramebufferReadBuffer(framebuffer_.id(), GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachment));
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(from.x, from.y, size.x, size.y, format, type, into);
}

} // namespace visorder::detail
