#pragma once

#include "scene/mesh.h"

#include <cstdint>
#include <string>
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

} // namespace visorder
