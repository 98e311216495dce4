#pragma once

#include "scene/cell_shape.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace visorder {

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

} // namespace visorder
