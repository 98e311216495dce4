#pragma once

#include "files/file_grid.h"

#include <cstddef>
#include <optional>

namespace visorder::detail {

/// What a VTK cell type is to a mesh.
struct CellKind {
    ListedShape shape;
    std::size_t corners; ///< how many of its points, which come first; 0: all
    bool higher_order;   ///< has points beyond its corners
    bool grid_ordered;   ///< pixel or voxel, whose points count along x, then y, then z, and not around faces
};

/// `vtk_type` is one of VTKCellType's values; nothing for a solid or surface that visorder has no shape for.
std::optional<CellKind> cell_kind(int vtk_type);

} // namespace visorder::detail
