#include "bsp/boundary_cells.h"

#include "scene/adjacency.h"

namespace visorder::detail {

BoundaryCells::BoundaryCells(std::span<const CellFace> faces, CellId cells) : rows_((std::size_t{cells} + 63) / 64)
{
    for (std::uint32_t face = 0; face < faces.size(); ++face) {
        const CellId cell = faces[face].cell;
        if (face == 0 || faces[face - 1].cell != cell)
            first_face_.push_back(face);
        of_face_.push_back(static_cast<std::uint32_t>(first_face_.size() - 1));
        rows_[cell / 64].bits |= std::uint64_t{1} << cell % 64;
    }
    first_face_.push_back(static_cast<std::uint32_t>(faces.size()));
    std::uint32_t before = 0;
    for (Row& row : rows_) {
        row.before = before;
        before += ones(row.bits);
    }
}

} // namespace visorder::detail
