#pragma once

#include "vtk/read_mesh.h"

namespace visorder {

/// The polygons of a Wavefront .obj file, split into triangles, over all its `v` points. Corners that name the same `v`
/// share a point, whatever texture coordinates and normals they have. Throws InputError, naming the file and the line.
MeshFile read_obj_file(const std::filesystem::path& path);

} // namespace visorder
