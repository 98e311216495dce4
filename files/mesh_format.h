#pragma once

#include "files/mesh_file.h"

#include <filesystem>
#include <span>

namespace visorder {

/// A format that meshes are read from.
struct MeshFormat {
    const char* ending; ///< of the file's name, in small letters
    /// Takes the scalar of the options, and leaves the rest of them to `read_mesh`.
    MeshFile (*read)(const std::filesystem::path& path, const ReadOptions& options);
    bool isolated = false; ///< whether a process of its own reads it, unless the options say otherwise
};

/// The formats that VTK reads: defined in vtk/, and so only in a build with VTK.
std::span<const MeshFormat> vtk_formats();

} // namespace visorder
