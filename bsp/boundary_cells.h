#pragma once

#include "scene/boundary.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace visorder {

/// The cells that own the faces of a BSP tree, numbered in their order.
class BoundaryCells {
public:
    /// `faces` are ascending by cell.
    BoundaryCells(std::span<const CellFace> faces, CellId cells);

    std::size_t count() const { return first_face_.size() - 1; }
    std::uint32_t of_face(std::uint32_t face) const { return of_face_[face]; }
    /// Of a cell that is one of them.
    std::size_t of_cell(CellId cell) const
    {
        const std::uint64_t below = bits_[cell / 64] & ((std::uint64_t{1} << cell % 64) - 1);
        return before_[cell / 64] + static_cast<std::size_t>(std::popcount(below));
    }
    /// The faces of one of them, from the first to before the second.
    std::pair<std::uint32_t, std::uint32_t> faces(std::size_t boundary_cell) const
    {
        return {first_face_[boundary_cell], first_face_[boundary_cell + 1]};
    }
    std::size_t bytes() const
    {
        return bits_.capacity() * sizeof(std::uint64_t) +
               (before_.capacity() + first_face_.capacity() + of_face_.capacity()) * sizeof(std::uint32_t);
    }

private:
    std::vector<std::uint64_t> bits_;   // a cell: whether it is one
    std::vector<std::uint32_t> before_; // how many there are before each 64 cells
    std::vector<std::uint32_t> first_face_;
    std::vector<std::uint32_t> of_face_;
};

} // namespace visorder
