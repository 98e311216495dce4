#pragma once

#include "visorder/scene.h"

namespace visorder::detail {

/// Throws InputError, naming the lowest cell in the caller's numbering, for a scene of solids with a face that is not
/// planar: such a cell is no convex body. Exact.
void require_planar_faces(const Scene& scene);

} // namespace visorder::detail
