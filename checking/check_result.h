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
    std::size_t relations = 0;  ///< distinct pairs (front, back), without those of cells that overlap in space
    std::size_t violations = 0; ///< how many of the relations the order does not satisfy, outside of `unorderable` sets
    std::size_t violations_in_cycles = 0; ///< and within them, where some relation must always go unsatisfied
    std::vector<Violation> witnesses;     ///< the first of `violations`, ascending by front and back
    /// Cells that overlap in space (a, b), a < b, ascending. No order of them exists; they count as no relation.
    std::vector<std::pair<CellId, CellId>> overlapping;
    /// Strongly connected sets of more than one cell under the relations, ascending as are the cells of each. No order
    /// satisfies all relations within one.
    std::vector<std::vector<CellId>> unorderable;

    bool order_exists() const { return unorderable.empty(); }
};

} // namespace visorder
