#include "visorder/error.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <oneapi/tbb/global_control.h>
#include <random>
#include <set>
#include <vector>

namespace visorder::tests {
namespace {

using Triangle = std::array<PointId, 3>;

/// The triangle with its smallest vertex first: the same for all ways to write one that keep its orientation.
Triangle turned(Triangle t)
{
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

Triangle reversed(const Triangle& t)
{
    return turned({t[0], t[2], t[1]});
}

bool all_distinct(std::span<const PointId> vertices)
{
    return std::set<PointId>(vertices.begin(), vertices.end()).size() == vertices.size();
}

/// Six times the volume of a tetrahedron, positive in VTK's order. Exact: the tests' coordinates are small integers.
long long volume_6(const Mesh& mesh, CellId cell)
{
    const auto v = mesh.cell(cell);
    const auto edge = [&](int i) {
        const glm::dvec3 d = mesh.points[v[i]] - mesh.points[v[0]];
        return std::array<long long, 3>{static_cast<long long>(d.x), static_cast<long long>(d.y),
                                        static_cast<long long>(d.z)};
    };
    const auto a = edge(1), b = edge(2), c = edge(3);
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

long long volume_6(const Mesh& mesh)
{
    long long sum = 0;
    for (CellId i = 0; i < mesh.cell_count(); ++i)
        sum += volume_6(mesh, i);
    return sum;
}

/// The faces of a tetrahedron, seen from outside.
std::vector<Triangle> faces_of(const Mesh& tetrahedra, CellId cell)
{
    std::vector<Triangle> faces;
    const auto v = tetrahedra.cell(cell);
    for (int face = 0; face < 4; ++face) {
        const auto corners = face_vertices(CellShape::tetrahedron, face);
        faces.push_back(turned({v[corners[0]], v[corners[1]], v[corners[2]]}));
    }
    return faces;
}

/// The faces of cell `cell` of a zoo, quadrilaterals cut from their smallest vertex, seen from outside.
std::vector<Triangle> cut_faces_of(const Mesh& zoo, CellId cell)
{
    std::vector<Triangle> faces;
    const auto v = zoo.cell(cell);
    for (int face = 0; face < face_count(zoo.shapes[cell]); ++face) {
        std::vector<PointId> f;
        for (const std::uint8_t corner : face_vertices(zoo.shapes[cell], face))
            f.push_back(v[corner]);
        std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
        for (std::size_t i = 2; i < f.size(); ++i)
            faces.push_back(turned({f[0], f[i - 1], f[i]}));
    }
    return faces;
}

/// A zoo cell on integer coordinates, its vertices in VTK's order.
Mesh single(CellShape shape)
{
    Mesh mesh;
    switch (shape) {
    case CellShape::hexahedron:
        mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
        break;
    case CellShape::wedge: // 0, 1, 2 are counterclockwise from outside, from below
        mesh.points = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}};
        break;
    case CellShape::pyramid:
        mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
        break;
    default:
        mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    }
    std::vector<PointId> vertices(mesh.points.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
    mesh.add(shape, vertices);
    return mesh;
}

/// The same mesh with point i renamed to names[i].
Mesh renumbered(const Mesh& mesh, const std::vector<PointId>& names)
{
    Mesh result = mesh;
    for (std::size_t i = 0; i < names.size(); ++i)
        result.points[names[i]] = mesh.points[i];
    for (PointId& v : result.vertices)
        v = names[v];
    return result;
}

std::vector<PointId> random_names(std::size_t count, std::mt19937& random)
{
    std::vector<PointId> names(count);
    std::iota(names.begin(), names.end(), 0u);
    std::shuffle(names.begin(), names.end(), random);
    return names;
}

/// Expects that the tetrahedra tile the cell: none is flat or inverted, each of their faces is met by one other from
/// the other side, and the faces left over are the cell's own, cut from their smallest vertices.
void expect_tiling_of_single_cell(const Mesh& zoo, const Mesh& tetrahedra)
{
    std::multiset<Triangle> open;
    for (CellId i = 0; i < tetrahedra.cell_count(); ++i) {
        EXPECT_GT(volume_6(tetrahedra, i), 0) << "tetrahedron " << i;
        for (const Triangle& face : faces_of(tetrahedra, i)) {
            const auto other_side = open.find(reversed(face));
            if (other_side != open.end())
                open.erase(other_side);
            else
                open.insert(face);
        }
    }
    const std::vector<Triangle> cut = cut_faces_of(zoo, 0);
    EXPECT_EQ(open, std::multiset<Triangle>(cut.begin(), cut.end()));
}

/// Runs a check for vertex numberings of one cell: all of them for up to six vertices, else 2000 drawn at random.
template <class Check>
void for_numberings(CellShape shape, const Check& check)
{
    const Mesh cell = single(shape);
    std::mt19937 random(7);
    std::vector<PointId> names(cell.points.size());
    std::iota(names.begin(), names.end(), 0u);
    if (names.size() <= 6) {
        do
            check(renumbered(cell, names));
        while (std::next_permutation(names.begin(), names.end()));
    } else {
        for (int i = 0; i < 2000; ++i)
            check(renumbered(cell, random_names(names.size(), random)));
    }
}

TEST(Subdivision, EveryNumberingOfAPyramidGivesTwoTetrahedraThatTileIt)
{
    for_numberings(CellShape::pyramid, [](const Mesh& pyramid) {
        const Subdivision result = subdivide(pyramid);
        EXPECT_EQ(result.cell_of, std::vector<CellId>(2, 0));
        EXPECT_EQ(volume_6(result.mesh), 2);
        expect_tiling_of_single_cell(pyramid, result.mesh);
    });
}

TEST(Subdivision, EveryNumberingOfAWedgeGivesThreeTetrahedraThatTileIt)
{
    for_numberings(CellShape::wedge, [](const Mesh& wedge) {
        const Subdivision result = subdivide(wedge);
        EXPECT_EQ(result.cell_of, std::vector<CellId>(3, 0));
        EXPECT_EQ(volume_6(result.mesh), 3);
        expect_tiling_of_single_cell(wedge, result.mesh);
    });
}

TEST(Subdivision, NumberingsOfAHexahedronGiveFiveOrSixTetrahedraThatTileIt)
{
    std::map<std::size_t, int> seen;
    for_numberings(CellShape::hexahedron, [&](const Mesh& hexahedron) {
        const Subdivision result = subdivide(hexahedron);
        const std::size_t parts = result.mesh.cell_count();
        ++seen[parts];
        EXPECT_TRUE(parts == 5 || parts == 6);
        EXPECT_EQ(result.cell_of, std::vector<CellId>(parts, 0));
        EXPECT_EQ(volume_6(result.mesh), 6);
        expect_tiling_of_single_cell(hexahedron, result.mesh);

        // Five parts stand for the case in which no diagonal ends opposite to the smallest vertex.
        const auto v = hexahedron.cell(0);
        const auto smallest = static_cast<std::size_t>(std::min_element(v.begin(), v.end()) - v.begin());
        const std::array<std::size_t, 8> opposite{6, 7, 4, 5, 2, 3, 0, 1};
        const PointId far = v[opposite[smallest]];
        const auto diagonals_at_far = [&] {
            int count = 0;
            for (int face = 0; face < 6; ++face) {
                std::array<PointId, 4> f{};
                std::ranges::transform(face_vertices(CellShape::hexahedron, face), f.begin(),
                                       [&](std::uint8_t corner) { return v[corner]; });
                std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
                count += f[0] == far || f[2] == far;
            }
            return count;
        };
        EXPECT_EQ(parts == 5, diagonals_at_far() == 0);
    });
    EXPECT_GT(seen[5], 100);
    EXPECT_GT(seen[6], 100);
}

TEST(Subdivision, TetrahedraAndTrianglesPassThrough)
{
    Mesh tetrahedra = single(CellShape::tetrahedron);
    tetrahedra.add(CellShape::tetrahedron, std::array<PointId, 4>{3, 1, 0, 2});
    tetrahedra.scalars = {1, 2, 3, 4};
    const Subdivision same = subdivide(tetrahedra);
    EXPECT_EQ(same.mesh.vertices, tetrahedra.vertices);
    EXPECT_EQ(same.mesh.scalars, tetrahedra.scalars);
    EXPECT_EQ(same.cell_of, (std::vector<CellId>{0, 1}));

    // Beside another shape too, whatever their vertices' order.
    Mesh zoo = tetrahedra;
    zoo.points.emplace_back(0, -1, 0);
    zoo.scalars.push_back(5);
    zoo.add(CellShape::pyramid, std::array<PointId, 5>{0, 1, 2, 3, 4});
    zoo.add(CellShape::tetrahedron, std::array<PointId, 4>{2, 1, 0, 4});
    const Subdivision mixed = subdivide(zoo);
    EXPECT_EQ(mixed.cell_of, (std::vector<CellId>{0, 1, 2, 2, 3}));
    EXPECT_EQ(mixed.mesh.points, zoo.points);
    EXPECT_EQ(mixed.mesh.scalars, zoo.scalars);
    EXPECT_EQ(mixed.mesh.offsets, (std::vector<std::uint32_t>{0, 4, 8, 12, 16, 20}));
    EXPECT_TRUE(std::ranges::equal(mixed.mesh.cell(1), tetrahedra.cell(1)));
    EXPECT_TRUE(std::ranges::equal(mixed.mesh.cell(4), zoo.cell(3)));

    Mesh surface;
    surface.points = tetrahedra.points;
    surface.add(CellShape::triangle, std::array<PointId, 3>{2, 1, 3});
    const Subdivision triangles = subdivide(surface);
    EXPECT_EQ(triangles.mesh.shapes, surface.shapes);
    EXPECT_EQ(triangles.mesh.vertices, surface.vertices);
    EXPECT_EQ(triangles.cell_of, std::vector<CellId>(1, 0));
}

TEST(Subdivision, AnInvalidMeshIsRefused)
{
    Mesh mesh = single(CellShape::wedge);
    mesh.vertices[4] = 6;
    EXPECT_THROW(subdivide(mesh), InputError);
    EXPECT_THROW(subdivide(Mesh{}), InputError);
}

/// A block of cells, each either a hexahedron or six pyramids around its middle, some columns of two wedges each, and
/// tetrahedra on the wedges at the top.
Mesh mixed_block(int n, std::mt19937& random)
{
    Mesh mesh;
    std::map<std::array<int, 3>, PointId> ids;
    const auto point = [&](int x, int y, int z) {
        const auto [entry, is_new] = ids.try_emplace({x, y, z}, static_cast<PointId>(mesh.points.size()));
        if (is_new)
            mesh.points.emplace_back(x, y, z);
        return entry->second;
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const bool wedges = random() % 4 == 0;
            for (int k = 0; k < n; ++k) {
                // Steps of 2 leave room for integer middles.
                const auto corner = [&](int di, int dj, int dk) {
                    return point(2 * (i + di), 2 * (j + dj), 2 * (k + dk));
                };
                const std::array<PointId, 8> c{corner(0, 0, 0), corner(1, 0, 0), corner(1, 1, 0), corner(0, 1, 0),
                                               corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)};
                if (wedges) {
                    mesh.add(CellShape::wedge, std::array<PointId, 6>{c[0], c[2], c[1], c[4], c[6], c[5]});
                    mesh.add(CellShape::wedge, std::array<PointId, 6>{c[0], c[3], c[2], c[4], c[7], c[6]});
                    if (k == n - 1) {
                        const PointId peak = point(2 * i + 1, 2 * j + 1, 2 * n + 1);
                        mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{c[4], c[5], c[6], peak});
                        mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{c[4], c[6], c[7], peak});
                    }
                } else if (random() % 3 == 0) {
                    const PointId middle = point(2 * i + 1, 2 * j + 1, 2 * k + 1);
                    for (int face = 0; face < 6; ++face) {
                        const auto f = face_vertices(CellShape::hexahedron, face);
                        mesh.add(CellShape::pyramid,
                                 std::array<PointId, 5>{c[f[0]], c[f[3]], c[f[2]], c[f[1]], middle});
                    }
                } else {
                    mesh.add(CellShape::hexahedron, c);
                }
            }
        }
    return mesh;
}

/// Expects that the tetrahedra with four distinct vertices meet face to face: of every triangle there is one, or there
/// are two from opposite sides. Returns those there is one of.
std::vector<Triangle> expect_face_to_face(const Mesh& tetrahedra)
{
    std::set<Triangle> seen;
    for (CellId i = 0; i < tetrahedra.cell_count(); ++i) {
        if (!all_distinct(tetrahedra.cell(i)))
            continue;
        for (const Triangle& face : faces_of(tetrahedra, i))
            EXPECT_TRUE(seen.insert(face).second) << "two on one side of the triangle " << face[0] << ' ' << face[1]
                                                  << ' ' << face[2] << ", one of them cell " << i;
    }
    std::vector<Triangle> open;
    for (const Triangle& face : seen)
        if (!seen.contains(reversed(face)))
            open.push_back(face);
    return open;
}

TEST(Subdivision, AMixedZooIsFaceToFaceWhateverItsNumbering)
{
    std::mt19937 random(3);
    for (int round = 0; round < 50; ++round) {
        const Mesh block = mixed_block(4, random);
        const Mesh zoo = renumbered(block, random_names(block.points.size(), random));
        const Subdivision result = subdivide(zoo);

        // The zoo's own boundary, cut from the smallest vertices.
        std::set<Triangle> boundary;
        for (CellId cell = 0; cell < zoo.cell_count(); ++cell)
            for (const Triangle& face : cut_faces_of(zoo, cell))
                if (boundary.erase(reversed(face)) == 0)
                    boundary.insert(face);
        const std::vector<Triangle> open = expect_face_to_face(result.mesh);
        EXPECT_EQ(std::set<Triangle>(open.begin(), open.end()), boundary);

        // Above each column of wedges stand two tetrahedra of 4/6 each.
        const auto peaks = std::ranges::count_if(block.points, [](const glm::dvec3& p) { return p.z == 9; });
        EXPECT_EQ(volume_6(result.mesh), 6 * 8 * 8 * 8 + 8 * peaks);
        for (CellId part = 0; part < result.mesh.cell_count(); ++part)
            EXPECT_GT(volume_6(result.mesh, part), 0);
        EXPECT_TRUE(std::ranges::is_sorted(result.cell_of));
    }
}

/// A grid of hexahedra over the points z * (i, i * j, 1), in which the line i = 0 is an axis that all cells around it
/// share, and z = 0 one point: hexahedra collapsed along an edge, along a face, and both.
Mesh collapsed_grid(int n)
{
    Mesh mesh;
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i)
                mesh.points.emplace_back(k * i, k * i * j, k);
    const auto point = [&](int i, int j, int k) { return static_cast<PointId>((k * (n + 1) + j) * (n + 1) + i); };
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                mesh.add(CellShape::hexahedron,
                         std::array<PointId, 8>{point(i, j, k), point(i + 1, j, k), point(i + 1, j + 1, k),
                                                point(i, j + 1, k), point(i, j, k + 1), point(i + 1, j, k + 1),
                                                point(i + 1, j + 1, k + 1), point(i, j + 1, k + 1)});
    weld(mesh);
    return mesh;
}

TEST(Subdivision, CollapsedHexahedraAgreeWithTheirNeighbours)
{
    constexpr int n = 4;
    std::mt19937 random(5);
    const Mesh grid = collapsed_grid(n);
    ASSERT_EQ(grid.points.size(), static_cast<std::size_t>(1 + n * (1 + n * (n + 1)))) << "axis and apex are welded";
    for (int round = 0; round < 300; ++round) {
        const Mesh zoo = renumbered(grid, random_names(grid.points.size(), random));
        const Subdivision result = subdivide(zoo);

        // What is open lies in the outer planes; the axis and the apex have no faces.
        for (const Triangle& face : expect_face_to_face(result.mesh)) {
            const auto all = [&](const auto& condition) {
                return std::ranges::all_of(face, [&](PointId v) { return condition(zoo.points[v]); });
            };
            EXPECT_TRUE(all([](const glm::dvec3& p) { return p.y == 0; }) ||
                        all([](const glm::dvec3& p) { return p.y == n * p.x; }) ||
                        all([](const glm::dvec3& p) { return p.x == n * p.z; }) ||
                        all([](const glm::dvec3& p) { return p.z == n; }))
                << face[0] << ' ' << face[1] << ' ' << face[2];
        }

        // At height z the grid is a triangle of area n * n * n * z * z / 2.
        EXPECT_EQ(volume_6(result.mesh), n * n * n * n * n * n);
        std::vector<int> parts(zoo.cell_count(), 0);
        for (CellId part = 0; part < result.mesh.cell_count(); ++part) {
            ++parts[result.cell_of[part]];
            EXPECT_EQ(volume_6(result.mesh, part) > 0, all_distinct(result.mesh.cell(part)));
        }
        EXPECT_TRUE(std::ranges::all_of(parts, [](int count) { return count == 5 || count == 6; }));
    }
}

TEST(Subdivision, CellsFoldedOntoOneEdgeAgreeOnIt)
{
    // Two hexahedra share the quadrilateral (a, b, c, c), in all numberings of its points and from each of its corners.
    std::vector<PointId> names{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10};
    std::mt19937 random(11);
    for (int round = 0; round < 2000; ++round) {
        Mesh mesh;
        mesh.points = {{0, 0, 1}, {3, 0, 1}, {0, 3, 1},             // a, b, c
                       {0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0},  // below
                       {0, 0, 2}, {3, 0, 2}, {3, 3, 2}, {0, 3, 2}}; // above
        std::array<PointId, 8> below{3, 4, 5, 6, 0, 1, 2, 2};
        std::array<PointId, 8> above{0, 1, 2, 2, 7, 8, 9, 10};
        // Turned about the shared face's normal, a cell is the same with another corner first.
        const auto turn = [&](std::array<PointId, 8>& cell) {
            const auto steps = static_cast<std::ptrdiff_t>(random() % 4);
            std::rotate(cell.begin(), cell.begin() + steps, cell.begin() + 4);
            std::rotate(cell.begin() + 4, cell.begin() + 4 + steps, cell.end());
        };
        turn(below);
        turn(above);
        mesh.add(CellShape::hexahedron, below);
        mesh.add(CellShape::hexahedron, above);
        std::shuffle(names.begin(), names.end(), random);
        const Mesh zoo = renumbered(mesh, names);

        const Triangle shared = turned({names[0], names[1], names[2]});
        for (const Triangle& face : expect_face_to_face(subdivide(zoo).mesh))
            EXPECT_TRUE(face != shared && face != reversed(shared));
    }
}

TEST(Subdivision, IsTheSameOnOneThreadAndOnMany)
{
    std::mt19937 random(13);
    const Mesh block = mixed_block(24, random);
    const Mesh zoo = renumbered(block, random_names(block.points.size(), random));
    const auto with_threads = [&](std::size_t threads) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        return subdivide(zoo);
    };
    const Subdivision one = with_threads(1);
    for (const std::size_t threads : {2u, 8u}) {
        const Subdivision many = with_threads(threads);
        EXPECT_EQ(one.mesh.vertices, many.mesh.vertices);
        EXPECT_EQ(one.mesh.offsets, many.mesh.offsets);
        EXPECT_EQ(one.mesh.shapes, many.mesh.shapes);
        EXPECT_EQ(one.cell_of, many.cell_of);
    }
}

} // namespace
} // namespace visorder::tests
