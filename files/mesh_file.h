#pragma once

#include "scene/mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace visorder {

/// What to take of a file.
struct ReadOptions {
    /// The array to take, of points or of cells, by its exact name; magnitudes, if it has several components. Empty:
    /// the format's default, which is the density in Plot3D and elsewhere the first array of one component that does
    /// not hold ids, of points, else of cells.
    std::string scalar = "";
    bool weld = false;         ///< join points with exactly equal coordinates (see `weld`),
    double weld_tolerance = 0; ///< or, where `weld` is set, within this distance of each other
    /// Of a file with time steps the one to take: "first", "last", "index:N" counted from 0, or its time. Empty: the
    /// last.
    std::string time = "";
    /// Have files whose reader is not proof against damage, VTK's, read by a process of its own (see
    /// reader_process.h). Without, a damaged file can crash the program or take all its time and memory.
    bool isolated = true;
};

/// A part of a file that has a name of its own: an element block, a grid, a piece.
struct MeshBlock {
    std::string name;
    std::uint64_t first_file_cell = 0; ///< the number in the file of its first cell (see MeshFile::file_cells)
};

/// A mesh as a file gave it, and what reading changed.
struct MeshFile {
    Mesh mesh;
    std::string scalar;             ///< name of the array taken, empty if none
    std::vector<std::string> notes; ///< one line on each thing that is not in the mesh as it is in the file

    /// For each cell of the mesh, the number that the cell it is part of has in the file: counted from 0 over all cells
    /// that the file lists, in the file's order over all blocks, cells that were left out included.
    std::vector<std::uint64_t> file_cells;
    std::vector<MeshBlock> blocks; ///< in the file's order; empty for a file without blocks
};

} // namespace visorder
