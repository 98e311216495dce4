#include "graphics/context.h"

#include "graphics/platform_context.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace visorder::detail {

namespace {

constexpr int needed_major = 4;
constexpr int needed_minor = 5;

// OpenGL itself knows one current context a thread.
thread_local const Context* current_context = nullptr;

std::unique_ptr<PlatformContext> make_platform_context(GlPlatform platform)
{
    if (platform == GlPlatform::egl)
        return make_egl_context();
    if (platform == GlPlatform::osmesa)
        return make_osmesa_context();
    std::string egl_lacks;
    try {
        return make_egl_context();
    } catch (const GraphicsError& error) {
        egl_lacks = error.what();
    }
    try {
        return make_osmesa_context();
    } catch (const GraphicsError& error) {
        throw GraphicsError(fmt::format("{}; {}", egl_lacks, error.what()));
    }
}

void APIENTRY keep_error(GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* text, const void* into)
{
    if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR)
        return;
    auto& reported = *static_cast<std::string*>(const_cast<void*>(into));
    if (reported.empty())
        reported = length < 0 ? std::string(text) : std::string(text, static_cast<std::size_t>(length));
    while (!reported.empty() && reported.back() == '\n')
        reported.pop_back();
}

std::string text_of(const GLubyte* text)
{
    return text == nullptr ? "" : reinterpret_cast<const char*>(text);
}

const char* error_name(GLenum error)
{
    switch (error) {
    case GL_INVALID_ENUM:
        return "invalid enum";
    case GL_INVALID_VALUE:
        return "invalid value";
    case GL_INVALID_OPERATION:
        return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
        return "out of memory";
    default:
        return "unknown error";
    }
}

} // namespace

Context::Context(GlPlatform platform)
    : platform_context_(make_platform_context(platform)), reported_(std::make_unique<std::string>())
{
    const Current current(*this);
    load_functions();
    renderer_ = text_of(gl_.GetString(GL_RENDERER));
    version_ = text_of(gl_.GetString(GL_VERSION));
    int major = 0;
    int minor = 0;
    gl_.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl_.GetIntegerv(GL_MINOR_VERSION, &minor);
    if (std::pair(major, minor) < std::pair(needed_major, needed_minor))
        throw GraphicsError(
            fmt::format("{} has OpenGL {}.{}; {}.{} is needed", renderer_, major, minor, needed_major, needed_minor));
    std::array<int, 2> viewport{};
    int texture = 0;
    gl_.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    largest_size_ = std::min({viewport[0], viewport[1], texture});
    report_errors();
}

Context::~Context()
{
    if (current_context == this) {
        platform_context_->release();
        current_context = nullptr;
    }
}

bool Context::is_software() const
{
    return renderer_.find("llvmpipe") != std::string::npos || renderer_.find("softpipe") != std::string::npos;
}

GlPlatform Context::platform() const
{
    return platform_context_->platform();
}

void Context::load_functions()
{
    // GetString first: without it a missing function could not be blamed on a renderer.
    gl_.GetString = reinterpret_cast<PFNGLGETSTRINGPROC>(platform_context_->function("glGetString"));
    const std::string renderer = gl_.GetString == nullptr ? std::string("OpenGL") : text_of(gl_.GetString(GL_RENDERER));
    const auto load = [&](auto& function, const char* title) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(platform_context_->function(title));
        if (function == nullptr)
            throw GraphicsError(
                fmt::format("{} lacks {}; OpenGL {}.{} is needed", renderer, title, needed_major, needed_minor));
    };
#define VISORDER_GL_LOAD(Type, Name) load(gl_.Name, "gl" #Name);
    VISORDER_GL_FUNCTIONS(VISORDER_GL_LOAD)
#undef VISORDER_GL_LOAD
}

void Context::report_errors()
{
    gl_.Enable(GL_DEBUG_OUTPUT);
    gl_.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl_.DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
    for (const GLenum type : {GL_DEBUG_TYPE_ERROR, GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR})
        gl_.DebugMessageControl(GL_DONT_CARE, type, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    gl_.DebugMessageCallback(keep_error, reported_.get());
}

void Context::check() const
{
    const GLenum error = gl_.GetError();
    if (reported_->empty() && error == GL_NO_ERROR)
        return;
    const std::string text = reported_->empty() ? error_name(error) : std::exchange(*reported_, {});
    while (gl_.GetError() != GL_NO_ERROR)
        ;
    throw GraphicsError(fmt::format("OpenGL ({}): {}", renderer_, text));
}

Context::Current::Current(const Context& context) : previous_(current_context)
{
    if (previous_ == &context)
        return;
    // The platforms share one notion of what is current inside Mesa, which one of them alone must set at a time.
    if (previous_ != nullptr)
        previous_->platform_context_->release();
    current_context = nullptr;
    context.platform_context_->make_current();
    current_context = &context;
}

Context::Current::~Current()
{
    if (current_context == previous_)
        return;
    if (current_context != nullptr)
        current_context->platform_context_->release();
    current_context = previous_;
    if (previous_ != nullptr)
        previous_->platform_context_->make_current();
}

} // namespace visorder::detail
