#include "projection/opengl/upload_ring.h"

namespace visorder::detail {

namespace {

// Of offsets of storage buffers; no renderer asks for more.
constexpr std::size_t alignment = 256;

// Of all that a vertex shader takes of a vertex, in bytes: 16 vectors.
constexpr std::size_t longest_vertex = 256;

std::size_t aligned(std::size_t bytes)
{
    return (bytes + alignment - 1) / alignment * alignment;
}

} // namespace

UploadRing::UploadRing(const Context& context, std::size_t segment_bytes, std::size_t segments)
    : context_(&context),
      segment_bytes_(aligned(segment_bytes)),
      buffer_(context, GlKind::buffer),
      fences_(segments, nullptr)
{
    const GlFunctions& gl = context.gl();
    constexpr GLbitfield flags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    // The attributes of the last vertex may reach beyond it.
    const auto bytes = static_cast<GLsizeiptr>(segment_bytes_ * segments + aligned(longest_vertex));
    gl.NamedBufferStorage(buffer_.id(), bytes, nullptr, flags);
    memory_ = static_cast<std::byte*>(gl.MapNamedBufferRange(buffer_.id(), 0, bytes, flags));
    context.check();
    if (memory_ == nullptr)
        throw GraphicsError("OpenGL (" + context.renderer() + "): a buffer cannot be mapped");
}

UploadRing::~UploadRing()
{
    const Context::Current current(*context_);
    for (const GLsync fence : fences_)
        if (fence != nullptr)
            context_->gl().DeleteSync(fence);
}

UploadRing::Segment UploadRing::next()
{
    const GlFunctions& gl = context_->gl();
    last_ = (last_ + 1) % fences_.size();
    if (GLsync& fence = fences_[last_]; fence != nullptr) {
        constexpr GLuint64 a_second = 1'000'000'000;
        while (gl.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, a_second) == GL_TIMEOUT_EXPIRED)
            ;
        gl.DeleteSync(fence);
        fence = nullptr;
    }
    return {{memory_ + last_ * segment_bytes_, segment_bytes_}, last_};
}

void UploadRing::bind(const Segment& segment, GLuint binding) const
{
    context_->gl().BindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer_.id(),
                                   static_cast<GLintptr>(segment.number * segment_bytes_),
                                   static_cast<GLsizeiptr>(segment_bytes_));
}

void UploadRing::bind_vertices(const Segment& segment, GLuint vertex_array, std::size_t stride) const
{
    context_->gl().VertexArrayVertexBuffer(vertex_array, 0, buffer_.id(),
                                           static_cast<GLintptr>(segment.number * segment_bytes_),
                                           static_cast<GLsizei>(stride));
}

void UploadRing::issued(const Segment& segment)
{
    fences_[segment.number] = context_->gl().FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

} // namespace visorder::detail
