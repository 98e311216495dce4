#include "scene/seen_face.h"

#include "scene/face_loop.h"

#include <algorithm>
#include <array>
#include <span>

namespace visorder::detail {

SeenFace seen_face(const Mesh& mesh, const CellFace& face, const glm::dvec4& eye)
{
    const FaceLoop loop = boundary_loop(mesh, face);
    std::array<glm::dvec3, max_face_vertices> points;
    std::transform(loop.begin(), loop.end(), points.begin(), [&](PointId v) { return mesh.points[v]; });
    return seen_face(std::span(points).first(static_cast<std::size_t>(loop.count)), eye);
}

} // namespace visorder::detail
