#pragma once

#include "scene/scene.h"
#include "scene/view.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace visorder {

/// A sequence of all cells of a scene, farthest first, in the caller's numbering.
struct Order {
    std::vector<CellId> back_to_front; ///< every cell exactly once
    std::vector<std::uint32_t>
        layer_begin; ///< where each layer starts in back_to_front; empty if the sorter makes none
    std::vector<std::vector<CellId>> cycles; ///< sets that no order can satisfy, each and all of them ascending
};

/// What a sorter promises on the scene it was made for. `exact`: right outside `Order::cycles`, for every eye.
enum class Guarantee { exact, approximate };

const char* name(Guarantee guarantee);

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
