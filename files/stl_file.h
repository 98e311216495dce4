#pragma once

#include "files/file_grid.h"

#include <string_view>

namespace visorder::detail {

/// The triangles of a stereolithography file (.stl), in text or binary. Each has points of its own there; those at
/// equal coordinates become one. Normals are passed over. Throws InputError, naming the file and the line or byte.
FileGrid read_stl_file(const std::filesystem::path& path, std::string_view content);

} // namespace visorder::detail
