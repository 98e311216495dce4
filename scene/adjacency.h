#pragma once

#include "scene/cell_shape.h"
#include "scene/large_array.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace visorder {

class Scene;

/// Which cells share a face, in rows of equal length: row i holds, for each face of cell i in the order of
/// `face_vertices`, the cell on its other side, or i itself where there is none (a boundary face, a face that the shape
/// does not have, or one collapsed to an edge or a point by repeated vertices). In a surface scene the faces are the
/// edges, and an edge of more than two triangles joins none of them.
///
/// A cell with fewer than four distinct vertices (a triangle with fewer than three) has no faces: its neighbours on
/// both sides meet directly.
struct Adjacency {
    int row_length;                    ///< 3 (triangles), 4 (tetrahedra) or 6
    LargeArray<CellId> neighbour;      ///< row_length a cell
    LargeArray<std::uint8_t> interior; ///< a cell: bit f is set if face f has a neighbour

    std::span<const CellId> row(CellId cell) const
    {
        return {neighbour.data() + std::size_t{cell} * static_cast<std::size_t>(row_length),
                static_cast<std::size_t>(row_length)};
    }
    /// Whether two different cells share a face.
    bool joins(CellId a, CellId b) const
    {
        const auto of_a = row(a);
        return std::find(of_a.begin(), of_a.end(), b) != of_a.end();
    }
};

/// Throws InputError, naming the cells (in the caller's numbering), for a face that three solids share.
Adjacency derive_adjacency(const Scene& scene);

/// The face of the neighbour across interior face `face` of `cell` that is this face, as an index into its own faces.
int matching_face(const Scene& scene, CellId cell, int face);

} // namespace visorder
