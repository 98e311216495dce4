#pragma once

#include "files/file_grid.h"

#include <string_view>

namespace visorder::detail {

/// The elements of a Gmsh mesh (.msh) of version 2, 4.0 or 4.1, in text or binary, or of version 1. The first view of
/// node data and element data of each name is its array, at its last time step unless `time` says otherwise (as in
/// ReadOptions). Throws InputError, naming the file and the line or byte.
FileGrid read_gmsh_file(const std::filesystem::path& path, std::string_view content, const std::string& time);

} // namespace visorder::detail
