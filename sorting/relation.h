#pragma once

#include "scene/cell_shape.h"

#include <compare>

namespace visorder {

/// One known pair: `front` obstructs `back`, in the inner numbering of a Scene.
struct Relation {
    CellId front;
    CellId back;

    friend bool operator==(const Relation&, const Relation&) = default;
    friend auto operator<=>(const Relation&, const Relation&) = default;
};

} // namespace visorder
