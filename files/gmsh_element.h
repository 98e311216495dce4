#pragma once

#include "files/file_grid.h"

#include <optional>

namespace visorder::detail {

/// An element type of Gmsh's files.
struct GmshElement {
    ListedShape shape;
    std::size_t nodes;
    std::size_t corners; ///< the first of the nodes
};

/// Nothing for a number that no supported type has.
std::optional<GmshElement> gmsh_element(std::int64_t type);

/// The corners of an element, given in Gmsh's order, in VTK's.
void reorder_gmsh_corners(ListedShape shape, std::span<std::int64_t> corners);

} // namespace visorder::detail
