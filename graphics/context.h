#pragma once

#include "graphics/gl_functions.h"
#include "visorder/error.h"
#include "visorder/gl_platform.h"

#include <cstddef>
#include <memory>
#include <string>

namespace visorder::detail {

class PlatformContext;

/// A headless OpenGL 4.5 core context, with no window and no default framebuffer to draw in. Any number of them in one
/// process, of both platforms; each on one thread at a time.
///
/// What OpenGL reports as an error through its debug output is kept, and thrown by `check`.
class Context {
public:
    /// Throws GraphicsError, with the renderer's name and what it lacks, where there is no OpenGL 4.5.
    explicit Context(GlPlatform platform = GlPlatform::automatic);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes a context current on this thread as long as it lives, and then the one that was before. Costs next to
    /// nothing where the context is current already.
    class Current {
    public:
        explicit Current(const Context& context);
        ~Current();
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;

    private:
        const Context* previous_;
    };

    const GlFunctions& gl() const { return gl_; }
    GlPlatform platform() const; ///< egl or osmesa
    const std::string& renderer() const { return renderer_; }
    const std::string& version() const { return version_; }
    /// Whether the processor draws: Mesa's llvmpipe or softpipe.
    bool is_software() const;

    /// The largest width or height of an image that can be drawn.
    int largest_size() const { return largest_size_; }

    /// Throws GraphicsError if OpenGL has reported an error since the last call, with its text. The context must be
    /// current.
    void check() const;

    /// GlObjects of this context that live now: to find leaks.
    std::size_t live_objects() const { return live_objects_; }

private:
    friend class GlObject;

    void load_functions();
    void report_errors();

    std::unique_ptr<PlatformContext> platform_context_;
    GlFunctions gl_;
    std::string renderer_;
    std::string version_;
    int largest_size_ = 0;
    std::unique_ptr<std::string> reported_; // the first error since the last `check`; OpenGL holds its address
    mutable std::size_t live_objects_ = 0;
};

} // namespace visorder::detail
