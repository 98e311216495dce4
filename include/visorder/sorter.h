#pragma once

#include "visorder/scene.h"
#include "visorder/view.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace visorder {

/// A sequence of all cells of a scene, farthest first, in the caller's numbering.
struct Order {
    std::vector<CellId> back_to_front; ///< every cell exactly once
    std::vector<std::uint32_t>
        layer_begin; ///< where each layer starts in back_to_front; empty if the sorter makes none
    std::vector<std::vector<CellId>> cycles; ///< sets that no order can satisfy, each and all of them ascending
};

/// What a sorter promises on the scene it was made for.
enum class Guarantee {
    exact,                  ///< no violated relation outside of `Order::cycles`, for every eye
    exact_but_for_overlaps, ///< likewise, among the pairs of cells that do not overlap in space; others have no order
    approximate             ///< nothing
};

/// "exact", "exact but" or "approximate".
const char* name(Guarantee guarantee);

/// The same in words, with what is left out: "exact but for 3 overlapping pairs" on a scene that has as many.
std::string describe(Guarantee guarantee, std::size_t overlapping_pairs);
std::string describe(Guarantee guarantee, const Scene& scene);

/// What a sorter promises on this scene that is right on every scene without overlapping cells.
Guarantee exact_up_to_overlaps(const Scene& scene);

/// A count or a time that tells what a sorter did.
struct Statistic {
    const char* name; ///< with its unit, where it has one
    double value;
    double whole = 0; ///< that it is a part of, or 0
};

/// One way of ordering the cells of one scene. Holds a reference to its Scene, which must outlive it. One `sort` at a
/// time on one sorter; any number of sorters on one Scene.
class Sorter {
public:
    virtual ~Sorter() = default;

    virtual Guarantee guarantee() const = 0;

    /// Orders all cells as seen from `view.eye`; reuses the Order's memory. The result depends on scene and view alone,
    /// not on threads or earlier calls. Throws InputError for an eye that is not finite or all zero.
    virtual void sort(const View& view, Order& order) = 0;

    /// Bytes the sorter itself holds, beyond the structures of its Scene.
    virtual std::size_t bytes() const { return 0; }

    /// What making the sorter and its last `sort` took, sorter by sorter: rays shot, nodes visited, pairs tested. The
    /// same names in the same order on every call.
    virtual std::vector<Statistic> statistics() const { return {}; }
};

} // namespace visorder
