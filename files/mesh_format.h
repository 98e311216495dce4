#pragma once

#include "files/file_grid.h"

#include <filesystem>
#include <span>
#include <string_view>

namespace visorder::detail {

/// A format that meshes are read from. Readers throw InputError, naming the file.
struct MeshFormat {
    const char* ending; ///< of the file's name, in small letters
    /// Reads a file as a whole, which may have been compressed; null if the format is VTK's.
    FileGrid (*read_content)(const std::filesystem::path& path, std::string_view content, const ReadOptions& options);
    /// Reads a file, and maybe others that it names; null if `read_content` does.
    FileGrid (*read_file)(const std::filesystem::path& path, const ReadOptions& options);
    bool isolated = false;     ///< whether a process of its own reads it, unless the options say otherwise
    bool names_others = false; ///< files of this format name others, relative to where they are
};

/// The formats that VTK reads: defined in vtk/, and so only in a build with VTK.
std::span<const MeshFormat> vtk_formats();

} // namespace visorder::detail
