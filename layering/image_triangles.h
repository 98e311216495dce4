#pragma once

#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// What is drawn into an item buffer: items 0 to n-1, each one triangle or two that share a side.
struct ItemMesh {
    std::vector<std::array<PointId, 3>> triangles; ///< ascending by item; indices into the Scene's points
    std::vector<std::uint32_t> begin;              ///< item i's triangles are begin[i] up to begin[i + 1]

    std::uint32_t item_count() const { return static_cast<std::uint32_t>(begin.size() - 1); }
};

/// The triangles of a surface scene: item i is the caller's cell i.
ItemMesh surface_items(const Scene& scene);

/// The boundary faces of a scene of solids: item i is the i-th of `boundary().faces`. Collapsed faces have no triangle.
ItemMesh boundary_items(const Scene& scene);

/// A triangle as one image sees it: what decides, for each sample point, whether the triangle covers it, and how near
/// it is there. The layout is that of `Triangle` in item_buffer.cpp's shaders.
struct alignas(16) ImageTriangle {
    std::array<glm::vec4, 3> corners; ///< to be drawn, in clip space: a little larger than the triangle
    std::array<glm::dvec3, 3> edges;  ///< with (x, y, 1) of a point inside: positive. From `origin`, in pixels
    glm::dvec3 depth;                 ///< likewise: from 1, nearest, to 0, farthest
    glm::ivec2 origin;                ///< a corner of a pixel, near the triangle
    std::uint32_t item;
    std::uint32_t unused;
};
static_assert(sizeof(ImageTriangle) == 160);

/// Those of some items.
struct ImageTriangles {
    std::vector<ImageTriangle> triangles; ///< ascending by item, and within an item as in the ItemMesh
    std::vector<std::uint32_t> begin;     ///< item i's triangles are begin[i] up to begin[i + 1]
};

/// Projects the `wanted` items (one flag each) of a mesh. Left out is what can cover no sample point, that is, no
/// centre of a pixel: triangles behind the eye, beside the image, or between sample points.
///
/// All is computed in doubles, in homogeneous pixel coordinates, so that triangles may reach behind the eye (Olano,
/// Greer 1997, Triangle scan conversion using 2D homogeneous coordinates). A triangle covers a sample point that lies
/// strictly inside its projection. OpenGL moves corners to a grid of 1/256 pixel; triangles are therefore drawn larger
/// by as much, but for those that reach behind the eye, and the edges decide. Only tips sharper than half a thousandth
/// of a radian may lose a part of their length, and what is nearer to the plane of the eye than a millionth of the
/// farthest point is cut off.
///
/// The depth is affine in the image and fitted to the points. What the far plane or the near plane of `world_to_clip`
/// would cut off stays.
void project(const ItemMesh& items, std::span<const std::uint8_t> wanted, std::span<const glm::dvec3> points,
             const glm::dmat4& world_to_clip, glm::ivec2 size, ImageTriangles& result);

} // namespace visorder::detail
