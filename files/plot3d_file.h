#pragma once

#include "files/file_grid.h"

#include <string_view>

namespace visorder::detail {

/// The grids of a Plot3D file and the solution on them beside it: NAMEq.bin for NAMExyz.bin, NAME.q for NAME.xyz,
/// NAME.x and NAME.p3d. Throws InputError, naming the file, where it has no layout that is known, or the solution does
/// not fit its grid.
FileGrid read_plot3d_file(const std::filesystem::path& path, std::string_view content);

} // namespace visorder::detail
