#pragma once

#include "graphics/context.h"

#include <utility>

namespace visorder::detail {

/// What OpenGL names by a number.
enum class GlKind { buffer, framebuffer, program, query, shader, texture, vertex_array };

/// Owner of one OpenGL object of a context, which must outlive it. Makes its context current to delete it, so it may
/// die anywhere on the context's thread.
class GlObject {
public:
    GlObject() = default;

    /// A new object. `target` is a texture's (GL_TEXTURE_2D), a query's (GL_TIME_ELAPSED) or a shader's
    /// (GL_VERTEX_SHADER); 0 for others. The context must be current.
    GlObject(const Context& context, GlKind kind, GLenum target = 0);
    ~GlObject() { reset(); }
    GlObject(GlObject&& other) noexcept
        : context_(std::exchange(other.context_, nullptr)), kind_(other.kind_), id_(std::exchange(other.id_, 0))
    {
    }
    GlObject& operator=(GlObject&& other) noexcept
    {
        reset();
        context_ = std::exchange(other.context_, nullptr);
        kind_ = other.kind_;
        id_ = std::exchange(other.id_, 0);
        return *this;
    }

    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }
    void reset() noexcept;

private:
    const Context* context_ = nullptr;
    GlKind kind_ = GlKind::buffer;
    GLuint id_ = 0;
};

} // namespace visorder::detail
