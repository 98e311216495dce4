#include "visorder/mesh.h"

#include <array>

namespace visorder {

namespace {

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

constexpr std::array<Shape, 5> shapes{{
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

const Shape& of(CellShape shape)
{
    return shapes[static_cast<std::size_t>(shape)];
}

} // namespace

const char* name(CellShape shape)
{
    return of(shape).name;
}

int vertex_count(CellShape shape)
{
    return of(shape).vertices;
}

int face_count(CellShape shape)
{
    return of(shape).faces;
}

std::span<const std::uint8_t> face_vertices(CellShape shape, int face)
{
    const Face& f = of(shape).face[static_cast<std::size_t>(face)];
    return {f.vertices.data(), f.count};
}

} // namespace visorder
