#pragma once

#include "checking/cycle_crossings.h"
#include "parallel/large_array.h"
#include "scene/adjacency.h"
#include "scene/derived.h"
#include "visorder/relation.h"
#include "visorder/scene.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

namespace visorder::detail {

/// Every relation that an order of a scene has to satisfy from one eye, and which cells have no order under them:
/// evaluated once, to check any number of orders. Threads may share one.
class RelationSet {
public:
    RelationSet(const Scene& scene, const glm::dvec4& eye);

    const glm::dvec4& eye() const { return eye_; }
    /// Distinct pairs (front, back), without those of cells that overlap in space.
    std::size_t count() const { return count_; }
    /// Calls visit(front, back) once for each, in the inner numbering.
    template <class Visit>
    void visit(Visit&& visit) const
    {
        visit_interior(0, scene_.cell_count(), visit);
        for (const Relation& relation : boundary_)
            visit(relation.front, relation.back);
    }

    /// The same of those across interior faces that are kept at the cells from `begin` to `end`: at the one with the
    /// lower number, as bits of its exit faces, and, above, of its entry faces.
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

    /// Between boundary cells, ascending.
    std::span<const Relation> boundary() const { return boundary_; }
    /// Cells that overlap in space, in the caller's numbering.
    const std::vector<std::pair<CellId, CellId>>& overlapping() const { return overlapping_; }

    struct UnorderableSets {
        std::vector<std::vector<CellId>> sets; ///< in the caller's numbering
        SetsAndNeighbours known;               ///< the same sets; all empty if there are none
    };
    /// Found by the first call, unless an order that satisfies all relations is known by then: then there are none.
    const UnorderableSets& unorderable() const;
    void an_order_is_known() const { an_order_is_known_ = true; }

private:
    void evaluate_interior();
    void evaluate_boundary();
    UnorderableSets find_unorderable() const;
    void find_neighbours(UnorderableSets& unorderable) const;

    Scene scene_;
    const Adjacency* adjacency_; // none in a surface scene
    glm::dvec4 eye_;
    LargeArray<std::uint16_t> interior_; // empty in a surface scene
    std::vector<Relation> boundary_;
    std::size_t count_ = 0;
    std::vector<std::pair<CellId, CellId>> overlapping_;
    mutable std::atomic<bool> an_order_is_known_{false};
    Derived<UnorderableSets> unorderable_;
};

} // namespace visorder::detail
