#pragma once

#include "checking/check_result.h"
#include "checking/ray_sequence.h"
#include "scene/scene.h"
#include "sorting/sorter.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder {

struct RayAuditOptions {
    std::size_t rays = 10'000;
    std::uint64_t seed = 1;
};

/// What the rays of an audit say about an order. Cells in the caller's numbering.
struct RayAuditResult {
    std::size_t rays = 0;
    std::size_t pairs = 0;             ///< of cells of which one is behind the other on a ray, ray by ray
    std::size_t overlapping_pairs = 0; ///< of cells that overlap along a ray, or triangles at one point of it
    /// Distinct pairs in the wrong order, but those within one cycle, and those of cells that overlap in space or
    /// triangles that cross in the image, where no ray need show it.
    std::size_t violations = 0;
    std::size_t violations_in_cycles = 0;
    std::vector<Violation> witnesses; ///< the first of `violations`, ascending by front and back
};

/// Rays from an eye through a scene, to hold orders against: along each ray, every cell must stand in the order before
/// all cells that the ray comes to after it has left that cell. A truth that needs no relations, no adjacency and no
/// boundary, for scenes of any size; what no ray meets, it does not know.
///
/// A quarter of the rays each goes through random points of the bounding box, random points of cells, centres of the
/// overlap of two cells' images, and points beside the crossings of their edges' images, from 1 to 1e-12 of the cell
/// away. The cells on a ray are exact (see ray_sequence.h); with the sorters, the audit shares the predicate
/// `side_of_plane`, the box hierarchy and, to tell cycles, `strongly_connected_components`; that two cells overlap it
/// finds by `occludes` (convex_body.h).
///
/// Made on all threads, the same for any number of them. Immutable. The Scene must outlive it.
class RayAudit {
public:
    /// Throws InputError for an eye that is not finite or all zero, and, naming the cell, for a scene with faces that
    /// are not planar.
    RayAudit(const Scene& scene, const glm::dvec4& eye, const RayAuditOptions& options = {});

    /// Two cells may stand either way round if they are in one strongly connected set under what the rays show and
    /// `cycles`: sets that are known to have no order, in the caller's numbering, such as CheckResult::unorderable.
    /// What a sorter says of its own cycles is no such knowledge.
    ///
    /// Throws InputError, naming a cell, for an order that does not list every cell exactly once.
    RayAuditResult check(const Order& order, std::span<const std::vector<CellId>> cycles = {},
                         CheckOptions options = {}) const;

    std::size_t ray_count() const { return sequences_.size(); }
    const RaySequence& sequence(std::size_t ray) const { return sequences_[ray]; }
    /// The point that a ray goes through.
    const glm::dvec3& through(std::size_t ray) const { return through_[ray]; }

private:
    std::vector<std::uint32_t> sets_without_order(std::span<const std::vector<CellId>> cycles) const;

    RayTracer tracer_;
    std::vector<glm::dvec3> through_;
    std::vector<RaySequence> sequences_;
};

} // namespace visorder
