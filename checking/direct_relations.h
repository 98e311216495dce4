#pragma once

#include "checking/check_result.h"
#include "scene/scene.h"
#include "sorting/relation.h"
#include "sorting/sorter.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

namespace visorder {

struct DirectOptions {
    std::size_t max_cells = 20'000; ///< of a scene with more, no relations are made
};

/// The relation "A occludes B" of all pairs of a scene's cells from one eye, from its definition: the truth for scenes
/// of some thousand cells. Pair by pair it is decided from the two cells' vertices and the eye (see convex_body.h),
/// with no knowledge of faces, neighbours, the boundary, or which cells overlap. With the sorters it shares the
/// predicate `side_of_plane`, the box hierarchy and, for the sets that have no order, `strongly_connected_components`.
///
/// Flat cells, and triangles seen edge-on, occlude nothing and are occluded by nothing. Two cells that each occlude the
/// other overlap in space, or are triangles that cross as seen from the eye: they have no order and no relation.
///
/// Takes time with the square of how deep cells lie behind each other: some microseconds per pair of tetrahedra whose
/// images' boxes meet. Made on all threads; the result is the same for any number of them. Immutable; refers to the
/// Scene, which must outlive it.
class DirectRelations {
public:
    /// Throws InputError for an eye that is not finite or all zero, a scene of more cells than the options allow, and,
    /// naming the cell, one with faces that are not planar.
    DirectRelations(const Scene& scene, const glm::dvec4& eye, const DirectOptions& options = {});

    /// Ascending, in the inner numbering.
    std::span<const Relation> relations() const { return relations_; }

    /// Holds an order against all relations, as OrderChecker does: a wrong pair within a strongly connected set is no
    /// violation. Throws InputError, naming a cell, for an order that does not list every cell exactly once.
    CheckResult check(const Order& order, CheckOptions options = {}) const;

private:
    void find_unorderable();

    const Scene& scene_;
    glm::dvec4 eye_;
    std::vector<Relation> relations_;
    std::vector<std::pair<CellId, CellId>> overlapping_; // caller's numbering
    std::vector<std::vector<CellId>> unorderable_;       // caller's numbering
    std::vector<std::uint32_t> set_of_;                  // of inner cells: 1 + index into unorderable_, or 0
};

} // namespace visorder
