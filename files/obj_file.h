#pragma once

#include "files/file_grid.h"

#include <string_view>

namespace visorder::detail {

/// The polygons of a Wavefront .obj file, over all its `v` points. Corners that name the same `v` share a point,
/// whatever texture coordinates and normals they have. Throws InputError, naming the file and the line.
FileGrid read_obj_file(const std::filesystem::path& path, std::string_view content);

} // namespace visorder::detail
