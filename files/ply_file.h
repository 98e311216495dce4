#pragma once

#include "files/file_grid.h"

#include <string_view>

namespace visorder::detail {

/// The polygons and strips of triangles of a PLY file (.ply), in text or binary of either byte order. Numbers of points
/// and faces beside coordinates and corners are its arrays; normals, colours and texture coordinates are taken only if
/// asked for by name. Throws InputError, naming the file and the line or byte.
FileGrid read_ply_file(const std::filesystem::path& path, std::string_view content);

} // namespace visorder::detail
