#pragma once

#include "visorder/mesh.h"
#include "visorder/relation.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace visorder {

namespace detail {
struct AuditedRays;
struct RaySequence;
class RelationSet;
} // namespace detail

struct CheckOptions {
    std::size_t max_witnesses = 16;
};

/// A relation that an order does not satisfy, cells in the caller's numbering: `front` occludes `back` but is painted
/// before it.
struct Violation {
    CellId front;
    CellId back;
    glm::dvec3 witness; ///< where a ray from the eye that has passed through `front` enters `back`, rounded
};

/// What is wrong with an order. Cells in the caller's numbering.
struct CheckResult {
    std::size_t relations = 0; ///< distinct pairs (front, back), without those of cells that overlap in space
    /// How many pairs stand in the order the wrong way round, outside of `unorderable` sets: the relations that it does
    /// not satisfy and, where one cell occludes another through members of such a set, pairs that are no relation.
    std::size_t violations = 0;
    std::size_t violations_across_cycles = 0; ///< those of them that are no relation
    std::size_t violations_in_cycles = 0;     ///< relations within sets, where some must always go unsatisfied
    std::vector<Violation> witnesses;         ///< the first of `violations`, ascending by front and back
    /// Cells that overlap in space (a, b), a < b, ascending. No order of them exists; they count as no relation.
    std::vector<std::pair<CellId, CellId>> overlapping;
    /// Strongly connected sets of more than one cell under the relations, ascending as are the cells of each. No order
    /// satisfies all relations within one.
    std::vector<std::vector<CellId>> unorderable;

    bool order_exists() const { return unorderable.empty(); }
};

/// Every relation that an order of a scene has to satisfy from one eye: made by OrderChecker::relations_at, to check
/// any number of orders. A handle: copies share what they refer to. Immutable; threads may share one.
class Relations {
public:
    const glm::dvec4& eye() const;
    /// Distinct pairs (front, back), without those of cells that overlap in space.
    std::size_t count() const;
    /// Calls visit(front, back) once for each, in the inner numbering.
    void visit(const std::function<void(CellId, CellId)>& visit) const;

private:
    friend class OrderChecker;

    explicit Relations(std::shared_ptr<const detail::RelationSet> set) : set_(std::move(set)) {}

    std::shared_ptr<const detail::RelationSet> set_;
};

/// Holds orders of a scene's cells against all relations of its cells from an eye: across every interior face whose
/// plane the eye is not in, and from the owner of every back-facing boundary face to the owner of every front-facing
/// one that it occludes in part. In a mesh whose cells meet face to face, or touch in any way without overlapping, an
/// order is right if and only if it satisfies these (Williams 1992; Silva, Mitchell and Williams 1998). In a surface
/// scene, the relations are all pairs of triangles of which one occludes the other.
///
/// Where relations run in cycles, some go unsatisfied, and pairs that one of them would have put in order are tried one
/// by one: see cycle_crossings.h.
///
/// All decisions are exact. Relations across interior faces are evaluated here, one by one, from what the scene knows
/// of its cells (adjacency, orientations, overlapping cells), as the sorters' are; those of boundary faces come from
/// sorting/boundary_relations, as those of `xmpvo-exact` do. DirectRelations and RayAudit are truths that share none of
/// this. Results do not depend on the number of threads. Any number of threads may use one checker.
class OrderChecker {
public:
    /// Throws InputError, naming a cell, for a scene with faces that are not planar.
    explicit OrderChecker(const Scene& scene);

    /// Throws InputError for an eye that is not finite or all zero.
    Relations relations_at(const glm::dvec4& eye) const;

    /// Throws InputError, naming a cell, for an order that does not list every cell exactly once.
    CheckResult check(const Relations& relations, const Order& order, CheckOptions options = {}) const;

    /// The same for one order.
    CheckResult check(const glm::dvec4& eye, const Order& order, CheckOptions options = {}) const
    {
        return check(relations_at(eye), order, options);
    }

private:
    Scene scene_;
};

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
/// images' boxes meet. Made on all threads; the result is the same for any number of them. Immutable.
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

    Scene scene_;
    glm::dvec4 eye_;
    std::vector<Relation> relations_;
    std::vector<std::pair<CellId, CellId>> overlapping_; // caller's numbering
    std::vector<std::vector<CellId>> unorderable_;       // caller's numbering
    std::vector<std::uint32_t> set_of_;                  // of inner cells: 1 + index into unorderable_, or 0
};

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
/// Made on all threads, the same for any number of them. Immutable.
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

    std::size_t ray_count() const;
    const detail::RaySequence& sequence(std::size_t ray) const;
    /// The point that a ray goes through.
    const glm::dvec3& through(std::size_t ray) const;

private:
    std::shared_ptr<const detail::AuditedRays> rays_;
};

} // namespace visorder
