#pragma once

#include "geometry/box_hierarchy.h"
#include "visorder/scene.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace visorder::detail {

/// The cells whose interior a ray passes through, in the order of where it enters them; inner numbering.
struct RaySequence {
    std::vector<CellId> cells;
    /// behind[i] is the place of the first cell that the ray enters where it leaves cell i or later (in a surface: of
    /// the first triangle that it comes to after triangle i). The cells between overlap cell i along the ray, and
    /// those from there on are behind it. Ascending.
    std::vector<std::uint32_t> behind;
};

/// Follows rays from an eye through a scene. Which cells a ray passes through, and in which order it enters and leaves
/// them, is decided exactly for any finite input: by interval arithmetic and, where that cannot tell, by rational
/// numbers. The ray is the one through exactly the given point. A ray along a face, an edge or a vertex passes through
/// the interior of no cell there; one that starts inside a cell passes through that first.
///
/// A cell is where its faces' planes have it on the inner side. Nothing is known of neighbours, and nothing is shared
/// with the sorters but `side_of_plane`, which says which side of a face a cell is on, and the box hierarchy. Any
/// number of threads may use one; the Scene must outlive it.
class RayTracer {
public:
    /// The eye is homogeneous, finite and not all zero; its weight may have either sign.
    RayTracer(const Scene& scene, const glm::dvec4& eye);

    /// Reuses the memory of `result`, which is empty if `through` is the eye itself or not finite.
    void trace(const glm::dvec3& through, RaySequence& result) const;

    /// Where a ray enters a cell of its sequence, rounded.
    glm::dvec3 entry(const glm::dvec3& through, CellId cell) const;

    const Scene& scene() const { return scene_; }
    const glm::dvec4& eye() const { return eye_; }

private:
    Scene scene_;
    glm::dvec4 eye_; // of a weight that is not negative
    BoxHierarchy hierarchy_;
};

} // namespace visorder::detail
