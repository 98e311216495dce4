#pragma once

#include "scene/mesh.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace visorder {

/// What to take of a file.
struct ReadOptions {
    /// The array to take, of points or of cells, by its exact name; magnitudes, if it has several components. Empty:
    /// the format's default, which is the density in Plot3D and elsewhere the first array of one component that does
    /// not hold ids, of points, else of cells.
    std::string scalar = "";
    bool weld = false; ///< join points with exactly equal coordinates (see `weld`)
};

/// A mesh as a file gave it, and what reading changed.
struct MeshFile {
    Mesh mesh;
    std::string scalar;             ///< name of the array taken, empty if none
    std::vector<std::string> notes; ///< one line on each thing that is not in the mesh as it is in the file
};

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
/// solid that visorder has no shape for, or has no array named `options.scalar`. Thread-safe; VTK files are read one at
/// a time, and meanwhile VTK's messages, those of other threads too, are collected rather than shown.
MeshFile read_mesh(const std::filesystem::path& file, const ReadOptions& options = {});

/// The endings of file names that `read_mesh` takes.
std::span<const char* const> mesh_file_endings();

} // namespace visorder
