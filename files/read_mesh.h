#pragma once

#include "files/mesh_file.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace visorder {

/// Reads a mesh, in a format chosen by the ending of the file's name:
/// - VTK's unstructured grids (.vtu) and legacy files of any kind of grid (.vtk);
/// - Exodus II (.ex2, .e, .exo): all element blocks as one mesh, at the first time step, without displacements;
/// - Plot3D: a binary file NAMExyz.bin of one grid, of any byte order, with its solution in NAMEq.bin beside it;
/// - Wavefront .obj: the polygons.
///
/// Cells keep the order of the file. Of cells of higher order the corners are taken, cell data is averaged to points,
/// points that no cell uses and cells that the file hides are left out. In a file with solids, cells of lower dimension
/// are left out; a file of surface cells alone becomes a surface mesh, split into triangles. `notes` tells of each of
/// these. The mesh is valid (see `validate`).
///
/// Throws InputError, naming the file, for one that is missing, damaged or of an unknown ending, that has no cells or a
/// solid that visorder has no shape for, or has no array named `options.scalar`; for one whose reader crashes, or takes
/// more time or memory than `limits_for` allows; and where the program for that cannot be found or started (see
/// reader_process.h). Thread-safe. Without `options.isolated`, VTK reads one file at a time, and meanwhile its
/// messages, those of other threads too, are collected rather than shown.
MeshFile read_mesh(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same from the bytes of a file in memory, which are not compressed: in the formats that VTK has no part in.
/// `name` tells the format, messages, and where further files are looked for.
MeshFile read_mesh_content(const std::filesystem::path& name, std::string_view content,
                           const ReadOptions& options = {});

/// The endings of file names that `read_mesh` takes.
std::vector<std::string> mesh_file_endings();

} // namespace visorder
