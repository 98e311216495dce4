#pragma once

#include "checking/check_result.h"
#include "checking/cycle_crossings.h"
#include "scene/large_array.h"
#include "scene/scene.h"
#include "sorting/relation.h"
#include "sorting/sorter.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <utility>
#include <vector>

namespace visorder {

/// Every relation that an order of a scene has to satisfy from one eye: made by OrderChecker::relations_at, to check
/// any number of orders. Refers to the checker's Scene, which must outlive it; threads may share it.
class Relations {
public:
    const glm::dvec4& eye() const { return eye_; }
    /// Distinct pairs (front, back), without those of cells that overlap in space.
    std::size_t count() const { return count_; }
    /// Calls visit(front, back) once for each, in the inner numbering.
    template <class Visit>
    void visit(Visit&& visit) const
    {
        visit_interior(0, scene_->cell_count(), visit);
        for (const Relation& relation : boundary_)
            visit(relation.front, relation.back);
    }

private:
    friend class OrderChecker;

    struct UnorderableSets {
        std::vector<std::vector<CellId>> sets; // caller's numbering
        SetsAndNeighbours known;               // the same sets; all empty if there are none
    };
    struct OnDemand {
        std::atomic<bool> an_order_is_known{false};
        Derived<UnorderableSets> unorderable;
    };

    Relations(const Scene& scene, const glm::dvec4& eye);

    void evaluate_interior();
    void evaluate_boundary();
    UnorderableSets find_unorderable() const;
    void find_neighbours(UnorderableSets& unorderable) const;
    const UnorderableSets& unorderable() const;

    // Relations across interior faces are kept at the cell with the lower number: bits of its exit faces, and, above,
    // of its entry faces.
    template <class Visit>
    void visit_interior(CellId begin, CellId end, Visit&& visit) const
    {
        for (CellId cell = begin; cell < end && !interior_.empty(); ++cell)
            for (std::uint32_t bits = interior_[cell], face = 0; bits != 0; bits >>= 1, ++face)
                if ((bits & 1u) != 0) {
                    const CellId neighbour = adjacency_->row(cell)[face % 8];
                    if (face < 8)
                        visit(cell, neighbour);
                    else
                        visit(neighbour, cell);
                }
    }

    const Scene* scene_;
    const Adjacency* adjacency_; // none in a surface scene
    glm::dvec4 eye_;
    LargeArray<std::uint16_t> interior_; // empty in a surface scene
    std::vector<Relation> boundary_;     // ascending
    std::size_t count_ = 0;
    std::vector<std::pair<CellId, CellId>> overlapping_; // caller's numbering
    std::unique_ptr<OnDemand> on_demand_;
};

/// Holds orders of a scene's cells against all relations of its cells from an eye: across every interior face whose
/// plane the eye is not in, and from the owner of every exit boundary face to the owner of every entry face that it
/// covers in part. In a mesh whose cells meet face to face, or touch in any way without overlapping, an order is right
/// if and only if it satisfies these (Williams 1992; Silva, Mitchell and Williams 1998). In a surface scene, the
/// relations are all pairs of triangles of which one covers the other.
///
/// Where relations run in cycles, some go unsatisfied, and pairs that one of them would have put in order are tried one
/// by one: see cycle_crossings.h.
///
/// All decisions are exact. Relations across interior faces are evaluated here, one by one, from what the scene knows
/// of its cells (adjacency, orientations, overlapping cells), as the sorters' are; those of boundary faces come from
/// sorting/boundary_relations, as those of `xmpvo-exact` do. DirectRelations and RayAudit are truths that share none of
/// this. Results do not depend on the number of threads. The Scene must outlive the checker; any number of threads may
/// use one.
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
    glm::dvec3 witness(const Relations& relations, CellId front, CellId back) const;

    const Scene& scene_;
};

} // namespace visorder
