#pragma once

#include "geometry/face_overlap.h"
#include "scene/adjacency.h"
#include "visorder/mesh.h"

#include <glm/vec4.hpp>

namespace visorder::detail {

/// As one eye sees it, a boundary face of a solid, or a triangle of a surface (face 0 of itself).
SeenFace seen_face(const Mesh& mesh, const CellFace& face, const glm::dvec4& eye);

} // namespace visorder::detail
