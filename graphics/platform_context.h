#pragma once

#include "graphics/context.h"

#include <memory>

namespace visorder::detail {

/// What a platform knows of a context: how to make it current on a thread, and where its functions are.
class PlatformContext {
public:
    virtual ~PlatformContext() = default;

    virtual GlPlatform platform() const = 0;

    /// Throw GraphicsError where the platform refuses.
    virtual void make_current() = 0;
    virtual void release() = 0;

    /// A function by its whole name, such as "glClear", or null. The context must be current.
    virtual void* function(const char* name) = 0;
};

/// OpenGL 4.5 core contexts. Throw GraphicsError, saying what is missing.
std::unique_ptr<PlatformContext> make_egl_context();
std::unique_ptr<PlatformContext> make_osmesa_context();

} // namespace visorder::detail
