#pragma once

#include "visorder/mesh.h"

namespace visorder {

/// One known pair: `front` occludes `back`, in the inner numbering of a Scene.
struct Relation {
    CellId front;
    CellId back;

    friend bool operator==(const Relation&, const Relation&) = default;
    friend bool operator<(const Relation& a, const Relation& b)
    {
        return a.front != b.front ? a.front < b.front : a.back < b.back;
    }
};

} // namespace visorder
