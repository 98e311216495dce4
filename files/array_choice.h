#pragma once

#include "files/file_grid.h"

namespace visorder {

/// The array of that name, of points rather than of cells if both have it; for an empty name the grid's default, or
/// the first of one component that does not hold ids; null if there is none. Throws InputError, which lists the arrays
/// there are, where the named one is missing.
const FileArray* choose_array(const FileGrid& grid, const std::string& name);

} // namespace visorder
