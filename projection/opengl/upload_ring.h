#pragma once

#include "graphics/gl_object.h"

#include <cstddef>
#include <span>
#include <vector>

namespace visorder::detail {

/// Memory that the processor writes and the renderer reads, in segments that are used in turn, so that one is filled
/// while others are drawn from. Its context must be current where it is made and used.
class UploadRing {
public:
    UploadRing(const Context& context, std::size_t segment_bytes, std::size_t segments);
    ~UploadRing();
    UploadRing(const UploadRing&) = delete;
    UploadRing& operator=(const UploadRing&) = delete;

    struct Segment {
        std::span<std::byte> memory;
        std::size_t number;
    };

    /// The next segment, once nothing is drawn from it any more. Valid until all others have been given out.
    Segment next();

    /// Lets shaders read a segment, as the storage buffer of this binding.
    void bind(const Segment& segment, GLuint binding) const;

    /// Lets the vertices of a vertex array, `stride` bytes each, be read from a segment, as of its binding 0.
    void bind_vertices(const Segment& segment, GLuint vertex_array, std::size_t stride) const;

    /// Says that all draws from a segment have been issued.
    void issued(const Segment& segment);

    std::size_t segment_bytes() const { return segment_bytes_; }

private:
    const Context* context_;
    std::size_t segment_bytes_;
    GlObject buffer_;
    std::byte* memory_ = nullptr;
    std::vector<GLsync> fences_;
    std::size_t last_ = 0;
};

} // namespace visorder::detail
