#pragma once

#include "files/file_grid.h"
#include "vtk/vtk_file.h"

namespace visorder::detail {

/// The arrays of numbers, of points or of cells, that any part of a file has; where several have one of the same name,
/// it has as many components as in the first of them, and those that differ count as without it.
std::vector<FileArray> union_of_arrays(const VtkFile& file, bool on_cells);

} // namespace visorder::detail
