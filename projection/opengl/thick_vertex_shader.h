#pragma once

#include <string>

namespace visorder::detail {

/// The vertex shader of Projector::thick_gpu, but for its header: of each cell that ShaderThickTriangles writes, four
/// triangles, of which some may be points, with all that the fragment shader of silhouettes needs (see
/// SilhouetteLayout). It is fan_of, thickness_of and Thickness::interpolate over again, in doubles.
std::string thick_vertex_shader();

} // namespace visorder::detail
