#pragma once

#include <string>

namespace visorder::detail {

/// How the triangles of a surface get their colour.
enum class SurfaceColouring {
    flat,   ///< one colour
    scalars ///< of a transfer function, by the scalar at the pixel
};

std::string surface_vertex_shader(SurfaceColouring colouring);
std::string surface_fragment_shader(SurfaceColouring colouring, bool channels_apart);

} // namespace visorder::detail
