#pragma once

#include "visorder/mesh.h"

namespace visorder::scenes {

/// Leaves of the points, which have no scalars yet, those that a cell uses; they stay in order.
void drop_unused_points(Mesh& mesh);

} // namespace visorder::scenes
