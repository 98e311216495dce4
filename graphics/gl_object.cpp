#include "graphics/gl_object.h"

namespace visorder::detail {

namespace {

GLuint created(const GlFunctions& gl, GlKind kind, GLenum target)
{
    GLuint id = 0;
    switch (kind) {
    case GlKind::buffer:
        gl.CreateBuffers(1, &id);
        break;
    case GlKind::framebuffer:
        gl.CreateFramebuffers(1, &id);
        break;
    case GlKind::program:
        id = gl.CreateProgram();
        break;
    case GlKind::query:
        gl.CreateQueries(target, 1, &id);
        break;
    case GlKind::shader:
        id = gl.CreateShader(target);
        break;
    case GlKind::texture:
        gl.CreateTextures(target, 1, &id);
        break;
    case GlKind::vertex_array:
        gl.CreateVertexArrays(1, &id);
        break;
    }
    return id;
}

void destroy(const GlFunctions& gl, GlKind kind, GLuint id)
{
    switch (kind) {
    case GlKind::buffer:
        gl.DeleteBuffers(1, &id);
        break;
    case GlKind::framebuffer:
        gl.DeleteFramebuffers(1, &id);
        break;
    case GlKind::program:
        gl.DeleteProgram(id);
        break;
    case GlKind::query:
        gl.DeleteQueries(1, &id);
        break;
    case GlKind::shader:
        gl.DeleteShader(id);
        break;
    case GlKind::texture:
        gl.DeleteTextures(1, &id);
        break;
    case GlKind::vertex_array:
        gl.DeleteVertexArrays(1, &id);
        break;
    }
}

} // namespace

GlObject::GlObject(const Context& context, GlKind kind, GLenum target)
    : context_(&context), kind_(kind), id_(created(context.gl(), kind, target))
{
    if (id_ == 0) {
        context.check();
        throw GraphicsError("OpenGL (" + context.renderer() + "): an object cannot be made");
    }
    ++context.live_objects_;
}

void GlObject::reset() noexcept
{
    if (id_ == 0)
        return;
    const Context::Current current(*context_);
    destroy(context_->gl(), kind_, id_);
    --context_->live_objects_;
    id_ = 0;
}

} // namespace visorder::detail
