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

/// The tables behind the functions below, which loops over millions of cells want inlined.
namespace shape_tables {

struct Face {
    std::uint8_t count;
    std::array<std::uint8_t, max_face_vertices> vertices;
};

struct Shape {
    const char* name;
    int vertices;
    int faces;
    std::array<Face, max_cell_faces> face;
};

inline constexpr std::array<Shape, 5> shapes{{
    {"triangle", 3, 3, {{{2, {0, 1}}, {2, {1, 2}}, {2, {2, 0}}}}},
    {"tetrahedron", 4, 4, {{{3, {0, 1, 3}}, {3, {1, 2, 3}}, {3, {2, 0, 3}}, {3, {0, 2, 1}}}}},
    {"pyramid", 5, 5, {{{4, {0, 3, 2, 1}}, {3, {0, 1, 4}}, {3, {1, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 0, 4}}}}},
    {"wedge", 6, 5, {{{3, {0, 1, 2}}, {3, {3, 5, 4}}, {4, {0, 3, 4, 1}}, {4, {1, 4, 5, 2}}, {4, {2, 5, 3, 0}}}}},
    {"hexahedron",
     8,
     6,
     {{{4, {0, 4, 7, 3}},
       {4, {1, 2, 6, 5}},
       {4, {0, 1, 5, 4}},
       {4, {3, 7, 6, 2}},
       {4, {0, 3, 2, 1}},
       {4, {4, 5, 6, 7}}}}},
}};

constexpr const Shape& of(CellShape shape)
{
    return shapes[static_cast<std::size_t>(shape)];
}

} // namespace shape_tables

const char* name(CellShape shape);
{
    return shape_tables::of(shape).name;
}

/// Vertices of a cell of this shape: 3 to 8.
constexpr int vertex_count(CellShape shape)
{
    return shape_tables::of(shape).vertices;
}

/// Faces of a cell of this shape: 4 to 6, or the three edges of a triangle.
constexpr int face_count(CellShape shape)
{
    return shape_tables::of(shape).faces;
}

/// The vertices of a face, as indices into the cell's own vertices (VTK numbering), counterclockwise from outside where
/// the cell's vertices stand in VTK's order. Two for an edge of a triangle, else three or four.
/// `face` is in [0, face_count(shape)).
constexpr std::span<const std::uint8_t> face_vertices(CellShape shape, int face)
{
    const shape_tables::Face& f = shape_tables::of(shape).face[static_cast<std::size_t>(face)];
    return {f.vertices.data(), f.count};
}

} // namespace visorder
