#pragma once

#include "visorder/error.h"
#include "visorder/read_mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace visorder::detail {

/// What the cells of a mesh are called outside of the program, in orders and in messages: by the numbers that they have
/// in their file, or, where several cells are parts of one of the file's, by their own, with the map from these to the
/// file's.
///
/// Plain data behind a few questions; threads may share one.
class CellNumbers {
public:
    /// `file_cells` has, for each cell of the mesh, the number in the file of the cell that it is part of, ascending;
    /// `blocks` are the file's.
    CellNumbers(std::vector<std::uint64_t> file_cells, std::vector<MeshBlock> blocks);

    /// Whether every cell is a whole cell of the file. If so, orders list the file's numbers.
    bool whole() const { return whole_; }

    /// For each cell, the number in the file of the cell that it is part of.
    std::span<const std::uint64_t> file_cells() const { return file_cells_; }

    const std::vector<MeshBlock>& blocks() const { return blocks_; }

    /// The number that an order lists a cell by.
    std::uint64_t number(CellId cell) const { return whole_ ? file_cells_[cell] : cell; }
    std::vector<std::uint64_t> numbers(std::span<const CellId> cells) const;

    /// The cells that an order lists by these numbers. Throws InputError where they are not all cells of the mesh, each
    /// once.
    std::vector<CellId> cells(std::span<const std::uint64_t> numbers) const;

    /// As in a message: "cell 12", "cell 12 (block 'fuel', its cell 3)" or "part 57 (of cell 12)".
    std::string name(CellId cell) const;

    /// What the error says, of the cell by its name.
    std::string message(const CellError& error) const
    {
        return name(static_cast<CellId>(error.cell())) + ": " + error.fault();
    }

private:
    std::string block_of(std::uint64_t file_cell) const;

    std::vector<std::uint64_t> file_cells_;
    std::vector<MeshBlock> blocks_;
    bool whole_;
};

/// Of the cells of a mesh as it was read. A file that keeps no numbers gave all its cells.
CellNumbers cell_numbers(const MeshFile& file);

/// Of the cells of a subdivision of that mesh.
CellNumbers cell_numbers(const MeshFile& file, std::span<const CellId> cell_of);

} // namespace visorder::detail
