#include "graphics/platform_context.h"

#include <GL/osmesa.h>
#include <array>
#include <cstdint>
#include <dlfcn.h>
#include <fmt/format.h>

namespace visorder::detail {

namespace {

// Loaded, not linked: libOSMesa defines all of OpenGL's functions by name, and would take the place of those of other
// OpenGL users in the process.
class OsMesaLibrary {
public:
    OsMesaLibrary() : library_(dlopen(file, RTLD_NOW | RTLD_LOCAL))
    {
        if (library_ == nullptr)
            throw GraphicsError(fmt::format("OSMesa: {} cannot be loaded", file));
        load(create, "OSMesaCreateContextAttribs");
        load(destroy, "OSMesaDestroyContext");
        load(make_current, "OSMesaMakeCurrent");
        load(function, "OSMesaGetProcAddress");
    }

    decltype(&OSMesaCreateContextAttribs) create = nullptr;
    decltype(&OSMesaDestroyContext) destroy = nullptr;
    decltype(&OSMesaMakeCurrent) make_current = nullptr;
    decltype(&OSMesaGetProcAddress) function = nullptr;

private:
    static constexpr const char* file = "libOSMesa.so.8";

    template <class Function>
    void load(Function& into, const char* name)
    {
        into = reinterpret_cast<Function>(dlsym(library_, name));
        if (into == nullptr)
            throw GraphicsError(fmt::format("OSMesa: {} lacks {}", file, name));
    }

    void* library_; // never closed: Mesa's threads may outlive the last context
};

class OsMesaContext final : public PlatformContext {
public:
    OsMesaContext()
    {
        constexpr std::array<int, 9> attributes{OSMESA_FORMAT,
                                                OSMESA_RGBA,
                                                OSMESA_PROFILE,
                                                OSMESA_CORE_PROFILE,
                                                OSMESA_CONTEXT_MAJOR_VERSION,
                                                4,
                                                OSMESA_CONTEXT_MINOR_VERSION,
                                                5,
                                                0};
        context_ = library_.create(attributes.data(), nullptr);
        if (context_ == nullptr)
            throw GraphicsError("OSMesa: no OpenGL 4.5 core context");
    }

    ~OsMesaContext() override { library_.destroy(context_); }

    GlPlatform platform() const override { return GlPlatform::osmesa; }

    void make_current() override
    {
        if (library_.make_current(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE)
            throw GraphicsError("OSMesa: the context cannot be made current");
    }

    void release() override { library_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

    void* function(const char* name) override { return reinterpret_cast<void*>(library_.function(name)); }

private:
    OsMesaLibrary library_;
    OSMesaContext context_ = nullptr;
    std::array<std::uint8_t, 4> pixel_{}; // OSMesa wants a place for a default framebuffer, which is never drawn to
};

} // namespace

std::unique_ptr<PlatformContext> make_osmesa_context()
{
    return std::make_unique<OsMesaContext>();
}

} // namespace visorder::detail
