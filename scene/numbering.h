#pragma once

#include "parallel/large_array.h"
#include "visorder/mesh.h"

namespace visorder::detail {

/// Cells and points in the order of a Morton curve through the bounds of the points, by cell centres and by points:
/// what lies near in space lies near in memory.
struct Numbering {
    LargeArray<CellId> caller_cells;   ///< the caller's number of each inner cell
    LargeArray<PointId> caller_points; ///< the caller's number of each inner point
};

/// Renumbers a valid mesh in place and returns how.
Numbering renumber(Mesh& mesh);

} // namespace visorder::detail
