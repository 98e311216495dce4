#pragma once

#include "scene/cell_shape.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace visorder {

/// A cell that no triangles stand for (see VisibleCells), and how many triangles stand before it.
struct CellApart {
    std::uint32_t triangles_before;
    CellId cell;
};

/// What a projector makes of cells, in the form that its vertex shader reads: triangles in sequence, each of some
/// number of bytes. Threads may share one.
class CellTriangles {
public:
    virtual ~CellTriangles() = default;

    virtual std::size_t triangle_bytes() const = 0;
    virtual std::size_t most_a_cell() const = 0;

    /// Writes the triangles of the cells (inner numbering) in their sequence, and returns how many. Cells set
    /// apart get none, and are listed.
    virtual std::size_t make(std::span<const CellId> cells, std::byte* into, std::vector<CellApart>& apart) const = 0;
};

} // namespace visorder
