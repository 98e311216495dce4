#pragma once

#include "scene/boundary.h"
#include "scene/face_overlap.h"
#include "scene/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace visorder {

/// The corners of the faces of a BSP tree, without repetitions, by numbers of their own. Immutable.
class FaceCorners {
public:
    using Corners = std::array<std::uint32_t, 4>;

    /// `has_area` tells the faces to take; the others have no corners.
    FaceCorners(const Mesh& mesh, std::span<const CellFace> faces, std::span<const std::uint8_t> has_area);

    /// Of a face, in order around it, the first three not on one line. The last of three stands twice.
    const Corners& of(std::uint32_t face) const { return corners_[face]; }
    static int count(const Corners& corners) { return corners[2] == corners[3] ? 3 : 4; }
    static bool has(const Corners& corners, std::uint32_t corner)
    {
        return corners[0] == corner || corners[1] == corner || corners[2] == corner || corners[3] == corner;
    }

    /// Where the corners are.
    std::span<const glm::dvec3> points() const { return points_; }
    /// A face as an eye sees it.
    SeenFace seen(std::uint32_t face, const glm::dvec4& eye) const;

    std::size_t face_count() const { return corners_.size(); }
    std::size_t bytes() const
    {
        return corners_.capacity() * sizeof(Corners) + points_.capacity() * sizeof(glm::dvec3);
    }

private:
    std::vector<Corners> corners_;
    std::vector<glm::dvec3> points_; // in the order of the scene's
};

} // namespace visorder
