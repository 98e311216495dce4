#pragma once

#include <string_view>

namespace visorder {

/// Where an OpenGL context comes from.
enum class GlPlatform {
    automatic, ///< `egl`, or `osmesa` where that fails
    egl,       ///< EGL: a device with hardware when one is there, else Mesa's surfaceless platform
    osmesa     ///< Mesa's off-screen library: always software
};

const char* name(GlPlatform platform);

/// The platform of a name: auto, egl, osmesa. Throws InputError for another.
GlPlatform gl_platform(std::string_view name);

} // namespace visorder
