#pragma once

#include "visorder/mesh.h"

namespace visorder::detail {

/// Drops the points, with their scalars, that no cell uses; the others keep their relative order. Returns how many
/// went. The mesh's indices must be in range.
std::size_t drop_unused_points(Mesh& mesh);

} // namespace visorder::detail
