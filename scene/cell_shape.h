#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace visorder {

using CellId = std::uint32_t;
using PointId = std::uint32_t;

/// The shapes a cell can have: the finite-element zoo, and the triangle of surface scenes. Vertices are numbered as VTK
/// numbers them within each shape.
enum class CellShape : std::uint8_t { triangle, tetrahedron, pyramid, wedge, hexahedron };

inline constexpr int max_cell_vertices = 8;
inline constexpr int max_cell_faces = 6;
inline constexpr int max_face_vertices = 4;

const char* name(CellShape shape);

/// Vertices of a cell of this shape: 3 to 8.
int vertex_count(CellShape shape);

/// Faces of a cell of this shape: 4 to 6, or the three edges of a triangle.
int face_count(CellShape shape);

/// The vertices of a face, as indices into the cell's own vertices (VTK numbering), counterclockwise from outside where
/// the cell's vertices stand in VTK's order. Two for an edge of a triangle, else three or four.
/// `face` is in [0, face_count(shape)).
std::span<const std::uint8_t> face_vertices(CellShape shape, int face);

/// How many faces a set of them holds, a bit a face. A table, because plain x86-64 has no instruction to count bits.
inline constexpr auto bits_set = [] {
    std::array<std::uint8_t, 1 << max_cell_faces> table{};
    for (std::size_t bits = 1; bits < table.size(); ++bits)
        table[bits] = static_cast<std::uint8_t>(table[bits / 2] + bits % 2);
    return table;
}();

} // namespace visorder
