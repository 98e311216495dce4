#pragma once

#include "scene/adjacency.h"

#include <vector>

namespace visorder::detail {

/// The faces between which the relations of a scene of solids are sought that its interior faces do not carry,
/// ascending by cell and face: the boundary faces and, where cells overlap in space, also the interior faces of such
/// cells, from both sides.
///
/// Why these are enough: let a ray leave cell X and later enter cell Y, which X does not overlap. If X's face there is
/// an interior one, the ray goes on into the neighbour Z, and X occludes Z. If Z does not overlap Y, the same holds of
/// Z and Y, which are closer on the ray. If Z does overlap Y, both are among the cells that overlap, so that X's face
/// and every face of Y are here, and the pair of them shows the relation of X and Y. The same goes for Y and the cell
/// that the ray comes from. A flat cell between X and Z only takes the place of their common face.
std::vector<CellFace> derive_relation_faces(const Scene& scene);

} // namespace visorder::detail
