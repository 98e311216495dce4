#pragma once

#include "files/file_grid.h"

#include <string_view>

namespace visorder::detail {

/// The polygons of an Object File Format file (.off), in text or binary. Normals, colours and texture coordinates are
/// passed over. Throws InputError, naming the file and the line or byte.
FileGrid read_off_file(const std::filesystem::path& path, std::string_view content);

} // namespace visorder::detail
