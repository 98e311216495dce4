#include "scene/adjacency.h"

#include "meshes.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace visorder::tests {

using namespace detail;
namespace {

// Which cells share a face by comparing all of them, in the caller's numbering.
std::set<std::pair<CellId, CellId>> pairs_by_brute_force(const Mesh& mesh)
{
    std::map<std::set<PointId>, std::vector<CellId>> faces;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto v = mesh.cell(cell);
        if (std::set<PointId>(v.begin(), v.end()).size() < 4)
            continue;
        for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
            const FaceLoop loop = face_loop(mesh, cell, face);
            if (loop.count >= 3)
                faces[{loop.begin(), loop.end()}].push_back(cell);
        }
    }
    std::set<std::pair<CellId, CellId>> pairs;
    for (const auto& [key, cells] : faces)
        if (cells.size() == 2)
            pairs.emplace(std::min(cells[0], cells[1]), std::max(cells[0], cells[1]));
    return pairs;
}

std::set<std::pair<CellId, CellId>> pairs_of(const Scene& scene)
{
    std::set<std::pair<CellId, CellId>> pairs;
    const Adjacency& adjacency = scene.adjacency();
    for (CellId cell = 0; cell < scene.cell_count(); ++cell)
        for (std::size_t face = 0; face < adjacency.row(cell).size(); ++face) {
            const CellId neighbour = adjacency.row(cell)[face];
            EXPECT_EQ((adjacency.interior[cell] >> face & 1) != 0, neighbour != cell);
            if (neighbour == cell)
                continue;
            const auto back = adjacency.row(neighbour);
            EXPECT_NE(std::find(back.begin(), back.end(), cell), back.end());
            const CellId a = scene.caller_cells()[cell], b = scene.caller_cells()[neighbour];
            pairs.emplace(std::min(a, b), std::max(a, b));
        }
    return pairs;
}

TEST(Adjacency, IsThatOfBruteForceOnBoxesTetrahedraAndTheZoo)
{
    for (const Mesh& mesh : {cubes(4), subdivide(cubes(4)).mesh, zoo(), subdivide(zoo()).mesh, two_tetrahedra(),
                             cubes(3, [](int x, int y, int z) { return (x + y + z) % 2 == 0; })})
        EXPECT_EQ(pairs_of(Scene(mesh)), pairs_by_brute_force(mesh)) << mesh.cell_count() << " cells";
}

TEST(Adjacency, FindsManyFacesAtOnePoint)
{
    // A fan of tetrahedra around the edge 0-1, whose faces all have point 0 as their lowest.
    Mesh mesh;
    const std::uint32_t n = 200;
    mesh.points = {{0, 0, -1}, {0, 0, 1}};
    for (std::uint32_t i = 0; i < n; ++i)
        mesh.points.emplace_back(std::cos(i * 0.03), std::sin(i * 0.03), 0);
    for (std::uint32_t i = 0; i + 1 < n; ++i)
        add_tetrahedron(mesh, 0, 2 + i, 3 + i, 1);
    EXPECT_EQ(pairs_of(Scene(mesh)), pairs_by_brute_force(mesh));
}

std::set<std::set<CellId>> crowded_of(const Scene& scene)
{
    std::set<std::set<CellId>> crowded;
    for (const std::vector<CellId>& cells : scene.adjacency().crowded) {
        std::set<CellId> callers;
        for (const CellId cell : cells)
            callers.insert(scene.caller_cells()[cell]);
        EXPECT_TRUE(crowded.insert(callers).second) << "a face twice";
    }
    return crowded;
}

TEST(Adjacency, AFaceOfThreeCellsJoinsNone)
{
    Mesh mesh = two_tetrahedra();
    mesh.points.emplace_back(2, 2, 2);
    add_tetrahedron(mesh, 1, 2, 3, 5);
    mesh.points.emplace_back(0, 0, -1);
    add_tetrahedron(mesh, 0, 2, 1, 6); // meets the first at another face
    const Scene scene(std::move(mesh));
    EXPECT_EQ(crowded_of(scene), (std::set<std::set<CellId>>{{0, 1, 2}}));
    EXPECT_EQ(scene.traits().crowded_faces, 1u);
    EXPECT_FALSE(scene.traits().convex);
    EXPECT_FALSE(scene.traits().face_to_face);
    EXPECT_FALSE(scene.traits().delaunay);
    EXPECT_EQ(pairs_of(scene), (std::set<std::pair<CellId, CellId>>{{0, 3}}));
    EXPECT_EQ(scene.boundary().faces.size(), 14u) << "the face counts once for each of its cells";
}

TEST(Adjacency, ACellListedTwiceJoinsNothing)
{
    Mesh mesh = two_tetrahedra();
    add_tetrahedron(mesh, 0, 1, 2, 3);
    const Scene scene(std::move(mesh));
    EXPECT_EQ(crowded_of(scene), (std::set<std::set<CellId>>{{0, 1, 2}}));
    EXPECT_EQ(scene.adjacency().folded.size(), 6u) << "its other three faces, of two cells on one side";
    EXPECT_TRUE(pairs_of(scene).empty());
    EXPECT_EQ(scene.overlapping_cells().size(), 1u);
}

// More half faces at one vertex than are compared pair by pair, and more than three at a face.
TEST(Adjacency, FindsFacesOfManyCells)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::set<CellId> all;
    for (CellId cell = 0; cell < 40; ++cell) {
        mesh.points.emplace_back(cell, 1, cell % 2 == 0 ? 1 + cell : -1.0 - cell);
        add_tetrahedron(mesh, 0, 1, 2, 3 + cell);
        all.insert(cell);
    }
    EXPECT_EQ(crowded_of(Scene(mesh)), (std::set<std::set<CellId>>{all}));
    EXPECT_TRUE(pairs_of(Scene(mesh)).empty());
    mesh.shapes.resize(5);
    mesh.offsets.resize(6);
    mesh.vertices.resize(20);
    EXPECT_EQ(crowded_of(Scene(mesh)), (std::set<std::set<CellId>>{{0, 1, 2, 3, 4}}));
}

TEST(Adjacency, PassesThroughCellsWithRepeatedVertices)
{
    // Between the two lies a tetrahedron collapsed onto their common face.
    Mesh mesh = two_tetrahedra();
    add_tetrahedron(mesh, 1, 2, 3, 3);
    const auto pairs = pairs_of(Scene(mesh));
    EXPECT_EQ(pairs, (std::set<std::pair<CellId, CellId>>{{0, 1}}));
}

TEST(Adjacency, JoinsTrianglesAcrossEdgesOfTwoAlone)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {2, 0, 0}};
    mesh.add(CellShape::triangle, std::array{0u, 1u, 2u});
    mesh.add(CellShape::triangle, std::array{1u, 3u, 2u});
    mesh.add(CellShape::triangle, std::array{1u, 5u, 3u});
    EXPECT_EQ(pairs_of(Scene(mesh)), (std::set<std::pair<CellId, CellId>>{{0, 1}, {1, 2}}));
    mesh.add(CellShape::triangle, std::array{1u, 2u, 4u});
    EXPECT_EQ(pairs_of(Scene(mesh)), (std::set<std::pair<CellId, CellId>>{{1, 2}}));
}

TEST(Boundary, CountsFacesAndComponents)
{
    const Scene block(cubes(3));
    EXPECT_EQ(block.boundary().faces.size(), 54u);
    EXPECT_EQ(block.boundary().component_count, 1u);
    const Scene hollow(cubes(3, [](int x, int y, int z) { return x != 1 || y != 1 || z != 1; }));
    EXPECT_EQ(hollow.boundary().faces.size(), 60u);
    EXPECT_EQ(hollow.boundary().component_count, 2u);
    const Scene apart(cubes(3, [](int x, int, int) { return x != 1; }));
    EXPECT_EQ(apart.boundary().component_count, 2u);
}

} // namespace
} // namespace visorder::tests
