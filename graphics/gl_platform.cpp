#include "visorder/gl_platform.h"

#include "visorder/error.h"

#include <fmt/format.h>

namespace visorder {

const char* name(GlPlatform platform)
{
    switch (platform) {
    case GlPlatform::automatic:
        return "auto";
    case GlPlatform::egl:
        return "egl";
    case GlPlatform::osmesa:
        return "osmesa";
    }
    return "";
}

GlPlatform gl_platform(std::string_view wanted)
{
    for (GlPlatform platform : {GlPlatform::automatic, GlPlatform::egl, GlPlatform::osmesa})
        if (wanted == name(platform))
            return platform;
    throw InputError(fmt::format("no OpenGL platform \"{}\"; there are: auto, egl, osmesa", wanted));
}

} // namespace visorder
