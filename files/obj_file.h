#pragma once

#include "files/mesh_file.h"

#include <filesystem>

namespace visorder {

/// The polygons of a Wavefront .obj file, split into triangles, over all its `v` points. Corners that name the same `v`
/// share a point, whatever texture coordinates and normals they have. Throws InputError, naming the file and the line.
MeshFile read_obj_file(const std::filesystem::path& path, const ReadOptions& options);

} // namespace visorder
