#pragma once

#include "scene/adjacency.h"
#include "visorder/scene.h"

#include <cstdint>
#include <vector>

namespace visorder::detail {

/// The faces of solid cells (in a surface scene, the edges of triangles) that have no neighbour, ascending by cell and
/// face, and how they are connected.
struct Boundary {
    std::vector<CellFace> faces;
    std::vector<std::uint32_t> component; ///< per face: faces that share an edge are in one component; numbered from 0
    std::uint32_t component_count = 0;
};

Boundary derive_boundary(const Scene& scene);

} // namespace visorder::detail
