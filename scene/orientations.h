#pragma once

#include "geometry/exact_predicates.h"
#include "parallel/large_array.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <cstddef>
#include <cstdint>

namespace visorder::detail {

/// Which way round each cell's vertices stand, decided exactly.
struct Orientations {
    /// Per cell: 1 if its faces, as listed by `face_vertices`, are counterclockwise from outside; -1 if they are
    /// clockwise (an inverted cell: the same solid with its faces turned); 0 if it is flat. All 0 in a surface scene.
    LargeArray<std::int8_t> sign;
    std::size_t flat = 0;     ///< cells without volume (triangles without area)
    std::size_t inverted = 0; ///< cells of sign -1
};

/// Needs the mesh alone.
Orientations derive_orientations(const Scene& scene);

/// What Orientations::sign says of one solid cell, from its vertices alone. Exact.
Sign orientation_of(const Mesh& mesh, CellId cell);

} // namespace visorder::detail
