#pragma once

#include "parallel/large_array.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <algorithm>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace visorder::detail {

/// A face of a cell: `face` in [0, face_count(shape of cell)).
struct CellFace {
    CellId cell;
    std::uint32_t face;

    friend bool operator==(const CellFace&, const CellFace&) = default;
    friend auto operator<=>(const CellFace&, const CellFace&) = default; // NOLINT(modernize-use-nullptr)
};

/// Which cells share a face, in rows of equal length: row i holds, for each face of cell i in the order of
/// `face_vertices`, the cell on its other side, or i itself where there is none (a boundary face, a face that the shape
/// does not have, or one collapsed to an edge or a point by repeated vertices). In a surface scene the faces are the
/// edges, and an edge of more than two triangles joins none of them.
///
/// A cell with fewer than four distinct vertices (a triangle with fewer than three) has no faces: its neighbours on
/// both sides meet directly.
///
/// Two solid cells are neighbours only if they lie on different sides of the face that they share: so the side of the
/// eye gives every interior face a relation that holds. A flat tetrahedron has neighbours if all its faces with area
/// are shared with solid cells; then each cell above it occludes each cell below it, or the other way round, and the
/// relations across its faces say so. Every other flat cell has none, and its neighbours' faces are boundary faces.
struct Adjacency {
    int row_length;                    ///< 3 (triangles), 4 (tetrahedra) or 6
    LargeArray<CellId> neighbour;      ///< row_length per cell
    LargeArray<std::uint8_t> interior; ///< per cell: bit f is set if face f has a neighbour
    /// Faces that two solid cells on the same side of them share, from both cells, ascending by cell and face: the
    /// cells overlap there. They join nothing, and are boundary faces.
    std::vector<CellFace> folded;
    /// For each face that more than two solid cells share, its cells (each once, ascending), ascending. Two of them
    /// overlap there, or are the same cell twice. Such a face joins nothing, and is a boundary face of each.
    std::vector<std::vector<CellId>> crowded;

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

Adjacency derive_adjacency(const Scene& scene);

/// The face of the neighbour across interior face `face` of `cell` that is this face, as an index into its own faces.
int matching_face(const Scene& scene, CellId cell, int face);

} // namespace visorder::detail
