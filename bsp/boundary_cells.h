#pragma once

#include "scene/adjacency.h"
#include "scene/boundary.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace visorder::detail {

/// The cells that own the faces of a BSP tree, numbered in their order.
class BoundaryCells {
public:
    /// `faces` are ascending by cell.
    BoundaryCells(std::span<const CellFace> faces, CellId cells);

    std::size_t count() const { return first_face_.size() - 1; }
    std::uint32_t of_face(std::uint32_t face) const { return of_face_[face]; }
    /// Of a cell that is one of them.
    std::uint32_t of_cell(CellId cell) const
    {
        const Row& row = rows_[cell / 64];
        return row.before + ones(row.bits & ((std::uint64_t{1} << cell % 64) - 1));
    }
    /// The faces of one of them, from the first to before the second.
    std::pair<std::uint32_t, std::uint32_t> faces(std::size_t boundary_cell) const
    {
        return {first_face_[boundary_cell], first_face_[boundary_cell + 1]};
    }
    std::size_t bytes() const
    {
        return rows_.capacity() * sizeof(Row) + (first_face_.capacity() + of_face_.capacity()) * sizeof(std::uint32_t);
    }

private:
    // Of 64 cells.
    struct Row {
        std::uint64_t bits = 0;   // a cell: whether it is one
        std::uint32_t before = 0; // how many there are in the rows before
    };
    // Without an instruction for it, which not all processors have, std::popcount is a function call.
    static std::uint32_t ones(std::uint64_t bits)
    {
        bits -= bits >> 1 & 0x5555555555555555u;
        bits = (bits & 0x3333333333333333u) + (bits >> 2 & 0x3333333333333333u);
        bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fu;
        return static_cast<std::uint32_t>(bits * 0x0101010101010101u >> 56);
    }

    std::vector<Row> rows_;
    std::vector<std::uint32_t> first_face_;
    std::vector<std::uint32_t> of_face_;
};

} // namespace visorder::detail
