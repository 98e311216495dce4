#pragma once

#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <utility>
#include <vector>

namespace visorder::detail {

/// Whether the interiors of two cells have a point in common, decided exactly. The cells are convex with planar faces;
/// a flat one has no interior. Inner numbering.
bool interiors_overlap(const Scene& scene, CellId a, CellId b);

/// All pairs (a, b), a < b, of cells whose interiors have a point in common, ascending, in the inner numbering. No
/// order of such a pair exists. Empty for a surface scene, whose triangles have no interiors.
///
/// In a sound mesh this costs little: only the cells at the boundary, and one cell of each piece of the boundary
/// against all, are searched for a first such pair; where there is none there, there is none at all (see the source).
std::vector<std::pair<CellId, CellId>> derive_overlapping_cells(const Scene& scene);

} // namespace visorder::detail
