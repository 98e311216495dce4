#pragma once

#include "scene/cell_shape.h"

#include <cstdint>
#include <vector>

namespace visorder {

class Scene;

/// A face of a cell: `face` in [0, face_count(shape of cell)).
struct CellFace {
    CellId cell;
    std::uint32_t face;

    friend bool operator==(const CellFace&, const CellFace&) = default;
};

/// The faces owned by one cell, ascending by cell and face, and how they hang together.
struct Boundary {
    std::vector<CellFace> faces;
    std::vector<std::uint32_t> component; ///< of each face: faces that share an edge are in one; numbered from 0
    std::uint32_t component_count = 0;
};

Boundary derive_boundary(const Scene& scene);

} // namespace visorder
