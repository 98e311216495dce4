#pragma once

#include "files/file_grid.h"

#include <string_view>

namespace visorder::detail {

/// The cells of a MEDIT mesh in text (.mesh). Throws InputError, naming the file and the line.
FileGrid read_medit_file(const std::filesystem::path& path, std::string_view content);

/// Refuses MEDIT's binary meshes (.meshb).
FileGrid read_medit_binary_file(const std::filesystem::path& path, std::string_view content);

} // namespace visorder::detail
