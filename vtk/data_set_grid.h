#pragma once

#include "files/file_grid.h"
#include "vtk/vtk_file.h"

namespace visorder::detail {

/// The cells and arrays of all parts of a file, one part after the other, over the points that they share, or those of
/// one part after the other, each a piece. An array is listed if any part has it; elsewhere its values are NaN.
/// Throws InputError, naming the file and the cell (counted over all parts from 0), where there is no shape for one.
FileGrid grid_of(const VtkFile& file);

} // namespace visorder::detail
