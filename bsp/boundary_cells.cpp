#include "bsp/boundary_cells.h"

namespace visorder {

BoundaryCells::BoundaryCells(std::span<const CellFace> faces, CellId cells)
    : bits_((std::size_t{cells} + 63) / 64), before_(bits_.size())
{
    for (std::uint32_t face = 0; face < faces.size(); ++face) {
        const CellId cell = faces[face].cell;
        if (face == 0 || faces[face - 1].cell != cell)
            first_face_.push_back(face);
        of_face_.push_back(static_cast<std::uint32_t>(first_face_.size() - 1));
        bits_[cell / 64] |= std::uint64_t{1} << cell % 64;
    }
    first_face_.push_back(static_cast<std::uint32_t>(faces.size()));
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < bits_.size(); ++i) {
        before_[i] = before;
        before += static_cast<std::uint32_t>(std::popcount(bits_[i]));
    }
}

} // namespace visorder
