#include "visorder/mesh.h"

#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

// The paper splits a wedge by the plane through the two diagonals at its smallest vertex, and a hexahedron by the plane
// through a diagonal at its smallest vertex A and one at the opposite corner G. In every case the tetrahedra are those
// that join the smallest vertex to the triangles of the faces it is not part of, with one exception: where no diagonal
// ends at G, a hexahedron has five parts, a central tetrahedron between the six diagonals and four at its corners.
//
// Which parts there are depends on the shape, on where in the cell the smallest vertex stands, and on the diagonals of
// the (at most three) quadrilaterals that do not hold it: a table of all cases is made once.
//
// Repeated vertices cannot make two cells disagree on a face. The smallest index of a quadrilateral may stand at two of
// its corners. If they are opposite, both lie on the same diagonal. If they are neighbours, as in the collapsed
// quadrilateral (a, b, c, c), either diagonal leaves one triangle with three distinct vertices, the same one.

namespace visorder {

namespace {

constexpr std::size_t max_parts = 6;
constexpr std::size_t max_cells = std::size_t{1} << 29; // of a mesh, see `validate`

/// Positions within a cell's own vertices.
using Triangle = std::array<std::uint8_t, 3>;
using Quad = std::array<std::uint8_t, 4>;

struct Parts {
    std::uint32_t count = 0;
    std::array<Quad, max_parts> part{};

    void add(std::uint8_t a, std::uint8_t b, std::uint8_t c, std::uint8_t d) { part[count++] = {a, b, c, d}; }
};

/// The cases of one shape with its smallest vertex at one place.
struct Cases {
    std::uint32_t quads = 0;    ///< quadrilaterals that do not hold the smallest vertex
    std::array<Quad, 3> quad{}; ///< their corners
    std::array<Parts, 8>
        parts{}; ///< indexed by their diagonals: bit i is set if that of quad[i] runs from corner 1 to 3
};

constexpr int last_shape = static_cast<int>(CellShape::hexahedron);
using Table = std::array<std::array<Cases, max_cell_vertices>, last_shape + 1>;

/// The corner of a hexahedron that shares no face with another one.
std::uint8_t opposite_corner(std::uint8_t corner)
{
    return corner ^ 6;
}

/// The five parts of a hexahedron whose corner `far`, opposite to `smallest`, ends no diagonal. `triangles` has a
/// triangle with `far` in it and one without for each of the three faces at `far`.
Parts five_parts(std::uint8_t smallest, std::uint8_t far, const std::vector<Triangle>& triangles)
{
    Parts parts;
    std::vector<std::array<std::uint8_t, 2>> around_far; // of its triangles the edges opposite to it
    for (const Triangle& t : triangles) {
        const auto at = std::find(t.begin(), t.end(), far) - t.begin();
        if (at == 3)
            parts.add(smallest, t[0], t[1], t[2]);
        else
            around_far.push_back({t[(at + 1) % 3], t[(at + 2) % 3]});
    }
    // The three edges x-y, y-z and z-x enclose the base that the corner and the central tetrahedron share.
    const auto [x, y] = around_far[0];
    const std::uint8_t z = around_far[1][0] == y ? around_far[1][1] : around_far[1][0];
    parts.add(smallest, x, y, z);
    parts.add(far, x, z, y);
    return parts;
}

Cases cases_of(CellShape shape, std::uint8_t smallest)
{
    Cases cases;
    std::vector<Triangle> fixed;
    for (int face = 0; face < face_count(shape); ++face) {
        const auto corners = face_vertices(shape, face);
        if (std::find(corners.begin(), corners.end(), smallest) != corners.end())
            continue;
        if (corners.size() == 3)
            fixed.push_back({corners[0], corners[1], corners[2]});
        else
            cases.quad[cases.quads++] = {corners[0], corners[1], corners[2], corners[3]};
    }

    for (std::uint32_t diagonals = 0; diagonals < (1u << cases.quads); ++diagonals) {
        std::vector<Triangle> triangles = fixed;
        bool diagonal_at_far = false;
        for (std::uint32_t i = 0; i < cases.quads; ++i) {
            const std::uint32_t start = diagonals >> i & 1;
            const auto corner = [&](std::uint32_t k) { return cases.quad[i][(start + k) % 4]; };
            triangles.push_back({corner(0), corner(1), corner(2)});
            triangles.push_back({corner(0), corner(2), corner(3)});
            diagonal_at_far |= corner(0) == opposite_corner(smallest) || corner(2) == opposite_corner(smallest);
        }
        Parts& parts = cases.parts[diagonals];
        if (shape == CellShape::hexahedron && !diagonal_at_far)
            parts = five_parts(smallest, opposite_corner(smallest), triangles);
        else // A face's triangles are counterclockwise from outside, so these stand in VTK's order.
            for (const auto& [a, b, c] : triangles)
                parts.add(smallest, a, b, c);
    }
    return cases;
}

Table make_table()
{
    Table table;
    for (int shape = static_cast<int>(CellShape::tetrahedron); shape <= last_shape; ++shape)
        for (int smallest = 0; smallest < vertex_count(static_cast<CellShape>(shape)); ++smallest)
            table[shape][smallest] = cases_of(static_cast<CellShape>(shape), static_cast<std::uint8_t>(smallest));
    // A tetrahedron passes through with its vertices as they are.
    for (Cases& cases : table[static_cast<int>(CellShape::tetrahedron)])
        cases.parts[0].part[0] = {0, 1, 2, 3};
    return table;
}

/// The parts of a solid cell.
const Parts& parts_of(CellShape shape, std::span<const PointId> vertices)
{
    static const Table table = make_table();
    const auto smallest = std::min_element(vertices.begin(), vertices.end()) - vertices.begin();
    const Cases& cases = table[static_cast<std::size_t>(shape)][static_cast<std::size_t>(smallest)];
    std::uint32_t diagonals = 0;
    for (std::uint32_t i = 0; i < cases.quads; ++i) {
        const Quad& q = cases.quad[i];
        const PointId from_0 = std::min(vertices[q[0]], vertices[q[2]]);
        const PointId from_1 = std::min(vertices[q[1]], vertices[q[3]]);
        diagonals |= static_cast<std::uint32_t>(from_1 < from_0) << i;
    }
    return cases.parts[diagonals];
}

Subdivision unchanged(const Mesh& mesh)
{
    Subdivision result{mesh, std::vector<CellId>(mesh.cell_count())};
    for (std::size_t i = 0; i < mesh.cell_count(); ++i)
        result.cell_of[i] = static_cast<CellId>(i);
    return result;
}

} // namespace

Subdivision subdivide(const Mesh& mesh)
{
    validate(mesh);
    const std::size_t cells = mesh.cell_count();
    if (std::all_of(mesh.shapes.begin(), mesh.shapes.end(), [](CellShape s) { return s <= CellShape::tetrahedron; }))
        return unchanged(mesh);

    // Blocks of cells are counted, then filled where the counts before them end.
    constexpr std::size_t block_size = 4096;
    const std::size_t blocks = (cells + block_size - 1) / block_size;
    const auto for_cells = [&](std::size_t block, const auto& visit) {
        const std::size_t end = std::min(cells, (block + 1) * block_size);
        for (std::size_t i = block * block_size; i < end; ++i)
            visit(static_cast<CellId>(i), parts_of(mesh.shapes[i], mesh.cell(static_cast<CellId>(i))));
    };
    std::vector<std::size_t> begin(blocks + 1, 0);
    oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        std::size_t count = 0;
        for_cells(block, [&](CellId, const Parts& parts) { count += parts.count; });
        begin[block + 1] = count;
    });
    for (std::size_t block = 0; block < blocks; ++block)
        begin[block + 1] += begin[block];
    const std::size_t total = begin.back();
    if (total > max_cells)
        throw InputError(
            fmt::format("subdivision into {} tetrahedra: a mesh can have no more than {} cells", total, max_cells));

    Subdivision result;
    result.mesh.points = mesh.points;
    result.mesh.scalars = mesh.scalars;
    result.mesh.shapes.resize(total, CellShape::tetrahedron);
    result.mesh.offsets.resize(total + 1);
    result.mesh.vertices.resize(4 * total);
    result.cell_of.resize(total);
    oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        std::size_t next = begin[block];
        for_cells(block, [&](CellId cell, const Parts& parts) {
            const auto vertices = mesh.cell(cell);
            for (std::uint32_t part = 0; part < parts.count; ++part, ++next) {
                for (std::size_t k = 0; k < 4; ++k)
                    result.mesh.vertices[4 * next + k] = vertices[parts.part[part][k]];
                result.mesh.offsets[next + 1] = static_cast<std::uint32_t>(4 * (next + 1));
                result.cell_of[next] = cell;
            }
        });
    });
    return result;
}

} // namespace visorder
