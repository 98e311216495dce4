#pragma once

#include "files/mesh_file.h"
#include "vtk/vtk_file.h"

namespace visorder {

/// The mesh of all parts of a file, one after the other, with all points of the file. `scalar` as in ReadOptions.
/// Throws InputError, naming the file and the cell (counted over all parts from 0), where a cell cannot be taken.
MeshFile mesh_of(const VtkFile& file, const std::string& scalar);

} // namespace visorder
