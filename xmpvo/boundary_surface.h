#pragma once

#include "visorder/scene.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// The boundary of a scene of solids as rays meet it: its faces, points and edges alone, in the unit coordinates of the
/// face planes. Immutable once made.
struct BoundarySurface {
    /// A triangle repeats its last corner.
    using Corners = std::array<std::uint32_t, 4>;
    struct Edge {
        std::uint32_t a, b;       ///< points, a < b
        std::uint32_t begin, end; ///< of its faces in edge_faces; two, where the boundary is a manifold
    };

    std::vector<glm::dvec3> points;
    std::vector<Corners> faces; ///< numbered as Boundary::faces
    std::vector<Edge> edges;
    std::vector<std::uint32_t> edge_faces;
    bool triangles = true; ///< and no quadrilateral

    std::span<const std::uint32_t> corners(std::size_t face) const
    {
        return std::span(faces[face]).first(faces[face][2] == faces[face][3] ? 3 : 4);
    }
    std::size_t bytes() const;
};

BoundarySurface boundary_surface(const Scene& scene);

} // namespace visorder::detail
