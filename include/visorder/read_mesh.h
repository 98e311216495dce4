#pragma once

#include "visorder/mesh.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace visorder {

/// What to take of a file.
struct ReadOptions {
    /// The array to take, of points or of cells, by its exact name; magnitudes, if it has several components. Empty:
    /// the file's active scalars, unless they are ids; else the first array that varies and does not hold ids, of
    /// points before cells and of one component before several; else the first that does not hold ids.
    std::string scalar = "";
    bool weld = false;         ///< join points with exactly equal coordinates (see `weld`),
    double weld_tolerance = 0; ///< or, where `weld` is set, within this distance of each other
    /// Of a file with time steps the one to take: "first", "last", "index:N" counted from 0, or its time. Empty: the
    /// last.
    std::string time = "";
    /// Have files whose reader is not proof against damage, VTK's, read by a process of its own (see
    /// reader_process.h). Without, a damaged file can crash the program or take all its time and memory.
    bool isolated = true;
    bool list_arrays = false; ///< fill MeshFile::arrays, which takes a look at all of them
};

/// A part of a file that has a name of its own: an element block, a grid, a piece.
struct MeshBlock {
    std::string name;
    std::uint64_t first_file_cell = 0; ///< the number in the file of its first cell (see MeshFile::file_cells)
};

/// How the scalars of a mesh stand for those of a file: value = offset + scale * stored. Other than 0 and 1 only where
/// single precision would lose more of the file's range than 1e-5 of it, or cannot hold it.
struct ScalarMap {
    double offset = 0;
    double scale = 1;

    double value(double stored) const { return offset + scale * stored; }
    double stored(double value) const { return (value - offset) / scale; }
};

/// An array of numbers in a file.
struct ArraySummary {
    std::string name;
    std::string type; ///< of its numbers, as the file's reader calls it; empty if it does not say
    bool on_cells = false;
    std::int32_t components = 1;
    bool holds_ids = false;
    std::uint64_t finite = 0;  ///< how many values are: numbers, or magnitudes of several components
    std::uint64_t missing = 0; ///< how many are not: NaN, infinite, or of a part of the file without the array
    double lowest = 0;         ///< of the finite ones
    double highest = 0;
};

/// A mesh as a file gave it, and what reading changed.
struct MeshFile {
    Mesh mesh;
    std::string scalar;             ///< name of the array taken, empty if none
    ScalarMap scalar_map;           ///< from the mesh's scalars to that array's; a scalar that is missing is NaN
    std::vector<std::string> notes; ///< one line on each thing that is not in the mesh as it is in the file

    /// For each cell of the mesh, the number that the cell it is part of has in the file: counted from 0 over all cells
    /// that the file lists, in the file's order over all blocks, cells that were left out included.
    std::vector<std::uint64_t> file_cells;
    std::vector<MeshBlock> blocks;    ///< in the file's order; empty for a file without blocks
    std::vector<ArraySummary> arrays; ///< all that could be taken, if ReadOptions::list_arrays
};

/// Reads a mesh, in a format chosen by the ending of the file's name:
/// - VTK's XML files (.vtu, .vts, .vtr, .vti, .vtp), those that name others as pieces, blocks or time steps (.pvtu and
///   kin, .vtm, .vtmb, .vtpc, .vtpd, .pvd), and legacy files of any kind of grid (.vtk);
/// - Exodus II (.ex2, .ex2v2, .e, .exo, .g, .gen, .exoII, .exii): all element blocks, without displacements;
/// - Gmsh (.msh, versions 1, 2, 4.0 and 4.1, text and binary) and MEDIT (.mesh, text);
/// - Plot3D (NAMExyz.bin, .xyz, .x, .p3d), of any layout (see plot3d_layout.h), with its solution beside it;
/// - the polygons of .obj, .off, .ply and .stl.
/// Files of one of these formats, except those that name others, may be compressed by gzip (.gz).
///
/// Of a file with time steps one is taken (`options.time`). Pieces and blocks with points of their own are joined where
/// points are exactly equal; an array that some blocks or pieces alone have is NaN elsewhere. Prisms over pentagons and
/// hexagons, convex point sets and polyhedra are cut into tetrahedra (see `cut_into_tetrahedra`).
///
/// Cells keep the order of the file. Of cells of higher order the corners are taken, cell data is averaged to points,
/// points that no cell uses and cells that the file hides are left out. In a file with solids, cells of lower dimension
/// are left out; a file of surface cells alone becomes a surface mesh, split into triangles. `notes` tells of each of
/// these. The mesh is valid (see `validate`).
///
/// Throws InputError, naming the file, for one that is missing, damaged or of an unknown ending, that has no cells or a
/// solid that cannot be taken (of an unknown type, or a polyhedron with a dent that hides a part of it), or has no
/// array named `options.scalar`; for one whose reader crashes, or takes more time or memory than `limits_for` allows;
/// and where the program for that cannot be found or started (see reader_process.h). Thread-safe. Without
/// `options.isolated`, VTK reads one file at a time, and meanwhile its messages, those of other threads too, are
/// collected rather than shown.
MeshFile read_mesh(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same from the bytes of a file in memory, which are not compressed: in the formats that VTK has no part in.
/// `name` tells the format, messages, and where further files are looked for.
MeshFile read_mesh_content(const std::filesystem::path& name, std::string_view content,
                           const ReadOptions& options = {});

/// The endings of file names that `read_mesh` takes.
std::vector<std::string> mesh_file_endings();

} // namespace visorder
