#pragma once

#include "visorder/mesh.h"

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

namespace visorder::detail {

/// A cell as the convex hull of its vertices, and nothing else: no faces, no neighbours, no orientation. What is asked
/// of it is decided exactly, with `side_of_plane` as the only predicate.
struct ConvexBody {
    std::array<glm::dvec3, max_cell_vertices> vertices; ///< distinct
    int count = 0;

    std::span<const glm::dvec3> points() const { return {vertices.data(), static_cast<std::size_t>(count)}; }
};

ConvexBody body_of(const Mesh& mesh, CellId cell);

/// Whether a solid has an interior, or a triangle one that the eye sees: whether it can occlude anything or be
/// occluded. The eye is homogeneous, as in View, with a weight that is not negative.
bool can_occlude(const Mesh& mesh, CellId cell, const glm::dvec4& eye);

/// Whether some ray from the eye passes through the interior of `front` and later through that of `back`, both of which
/// `can_occlude`. Of two solids or triangles, each occludes the other if and only if the solids overlap in space or the
/// triangles cross as seen from the eye.
///
/// The idea: a point of `back`'s interior lies beyond a point x of `front`'s if x is inside the convex hull of `back`
/// and the eye. So `front` occludes `back` unless a plane separates it weakly from that hull. If any plane does, so
/// does one through three of all the points that span it; every three are tried.
bool occludes(const ConvexBody& front, const ConvexBody& back, const glm::dvec4& eye);

/// For bodies of which `front` occludes `back`: where a ray from the eye through the interiors of both enters `back`.
/// The ray is found in exact rational arithmetic, which takes tenths of a second for two hexahedra; the point is
/// rounded. The eye's weight may have either sign.
glm::dvec3 occlusion_witness(const ConvexBody& front, const ConvexBody& back, const glm::dvec4& eye);

} // namespace visorder::detail
