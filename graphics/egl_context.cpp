#include "graphics/platform_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace visorder::detail {

namespace {

bool lists(const char* extensions, std::string_view wanted)
{
    if (extensions == nullptr)
        return false;
    std::string_view rest = extensions;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == wanted)
            return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

template <class Function>
Function egl_function(const char* name)
{
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// Never terminated: a display is the process's, and others may use it too.
EGLDisplay initialised(EGLenum platform, void* native)
{
    const auto get_display = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    if (get_display == nullptr)
        return EGL_NO_DISPLAY;
    const EGLDisplay display = get_display(platform, native, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
        return EGL_NO_DISPLAY;
    return display;
}

// Of all devices but those that Mesa names software.
std::vector<EGLDisplay> hardware_displays(const char* client_extensions)
{
    std::vector<EGLDisplay> displays;
    if (!lists(client_extensions, "EGL_EXT_platform_device") || !lists(client_extensions, "EGL_EXT_device_enumeration"))
        return displays;
    const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto query_string = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    EGLint count = 0;
    if (query_devices == nullptr || query_string == nullptr || query_devices(0, nullptr, &count) != EGL_TRUE)
        return displays;
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    query_devices(count, devices.data(), &count);
    for (EGLDeviceEXT device : devices) {
        const char* extensions = query_string(device, EGL_EXTENSIONS);
        const bool hardware = lists(extensions, "EGL_EXT_device_drm") || lists(extensions, "EGL_NV_device_cuda");
        if (!hardware || lists(extensions, "EGL_MESA_device_software"))
            continue;
        if (const EGLDisplay display = initialised(EGL_PLATFORM_DEVICE_EXT, device); display != EGL_NO_DISPLAY)
            displays.push_back(display);
    }
    return displays;
}

EGLContext core_context(EGLDisplay display)
{
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    if (!lists(extensions, "EGL_KHR_surfaceless_context") || !lists(extensions, "EGL_KHR_create_context"))
        return EGL_NO_CONTEXT;
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!lists(extensions, "EGL_KHR_no_config_context")) {
        constexpr std::array<EGLint, 3> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
        EGLint found = 0;
        if (eglChooseConfig(display, wanted.data(), &config, 1, &found) != EGL_TRUE || found == 0)
            return EGL_NO_CONTEXT;
    }
    constexpr std::array<EGLint, 7> attributes{
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE)
        return EGL_NO_CONTEXT;
    return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

class EglContext final : public PlatformContext {
public:
    EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    ~EglContext() override { eglDestroyContext(display_, context_); }

    GlPlatform platform() const override { return GlPlatform::egl; }

    void make_current() override
    {
        eglBindAPI(EGL_OPENGL_API); // a setting of the thread
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
            throw GraphicsError(fmt::format("EGL: the context cannot be made current (error {:#x}): is it current on "
                                            "another thread?",
                                            eglGetError()));
    }

    void release() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

    void* function(const char* name) override { return reinterpret_cast<void*>(eglGetProcAddress(name)); }

private:
    EGLDisplay display_;
    EGLContext context_;
};

} // namespace

std::unique_ptr<PlatformContext> make_egl_context()
{
    const char* client_extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (client_extensions == nullptr)
        throw GraphicsError("EGL: no driver without a display");
    std::vector<EGLDisplay> displays = hardware_displays(client_extensions);
    if (lists(client_extensions, "EGL_MESA_platform_surfaceless"))
        if (const EGLDisplay display = initialised(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
            display != EGL_NO_DISPLAY)
            displays.push_back(display);
    if (displays.empty())
        throw GraphicsError("EGL: neither a device with hardware nor Mesa's surfaceless platform");
    for (EGLDisplay display : displays)
        if (const EGLContext context = core_context(display); context != EGL_NO_CONTEXT)
            return std::make_unique<EglContext>(display, context);
    const char* vendor = eglQueryString(displays.front(), EGL_VENDOR);
    throw GraphicsError(fmt::format("EGL ({}): no OpenGL 4.5 core context without a surface",
                                    vendor == nullptr ? "unknown vendor" : vendor));
}

} // namespace visorder::detail
