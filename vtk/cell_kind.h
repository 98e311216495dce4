#pragma once

#include "scene/cell_shape.h"

#include <cstddef>

namespace visorder {

/// What a VTK cell type is to a mesh.
struct CellKind {
    enum class Use {
        solid,       ///< a cell of `shape`
        polygon,     ///< a surface cell, by its corners in order
        strip,       ///< a surface cell: a strip of triangles
        lower,       ///< points and lines
        empty,       ///< no cell at all
        unsupported, ///< a solid or surface that visorder has no shape for
    };
    Use use;
    CellShape shape;     ///< of a solid
    std::size_t corners; ///< how many of its points, which come first; 0: all
    bool higher_order;   ///< has points beyond its corners
    bool grid_ordered;   ///< pixel or voxel, whose points count along x, then y, then z, and not around faces
};

/// `vtk_type` is one of VTKCellType's values.
CellKind cell_kind(int vtk_type);

} // namespace visorder
