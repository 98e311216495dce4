// Every VTK cell type: what shape it becomes, in which order its corners stand.

#include "scene/boundary.h"
#include "tests/reading_error.h"
#include "tests/temporary_folder.h"
#include "visorder/mesh.h"
#include "visorder/read_mesh.h"
#include "visorder/scene.h"
#include "vtu_text.h"

#include <cmath>
#include <gmock/gmock.h>
#include <numeric>
#include <vtkCellType.h>

using namespace visorder;
using namespace visorder::detail;
using namespace visorder::tests;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

const TemporaryFolder folder;

/// A cell over points 0, 1, 2..., which lie on a curve that no four of them make flat.
VtuText cell_of(int type, int points)
{
    VtuText vtu;
    for (int i = 0; i < points; ++i)
        vtu.points.push_back({double(i), double(i * i), double(i * i * i)});
    vtu.cells = {{type, std::vector<int>(static_cast<std::size_t>(points))}};
    std::iota(vtu.cells[0].points.begin(), vtu.cells[0].points.end(), 0);
    return vtu;
}

/// The unit square, counterclockwise from above, and its centre.
VtuText square()
{
    VtuText vtu;
    vtu.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    return vtu;
}

MeshFile read(const VtuText& vtu)
{
    return read_mesh(folder.write("mesh.vtu", vtu.str()));
}

} // namespace

TEST(CellKinds, TakesLinearSolidsAsTheyAre)
{
    for (const auto& [type, shape] : {std::pair{VTK_TETRA, CellShape::tetrahedron},
                                      {VTK_PYRAMID, CellShape::pyramid},
                                      {VTK_WEDGE, CellShape::wedge},
                                      {VTK_HEXAHEDRON, CellShape::hexahedron}}) {
        const MeshFile file = read(cell_of(type, vertex_count(shape)));
        EXPECT_THAT(file.mesh.shapes, ElementsAre(shape));
        std::vector<std::uint32_t> in_order(static_cast<std::size_t>(vertex_count(shape)));
        std::iota(in_order.begin(), in_order.end(), 0u);
        EXPECT_EQ(file.mesh.vertices, in_order);
        EXPECT_THAT(file.notes, IsEmpty());
    }
}

TEST(CellKinds, ReordersAVoxel)
{
    const MeshFile file = read(cell_of(VTK_VOXEL, 8));
    EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::hexahedron));
    EXPECT_THAT(file.mesh.cell(0), ElementsAre(0, 1, 3, 2, 4, 5, 7, 6));
}

TEST(CellKinds, TakesTheCornersOfCellsOfHigherOrder)
{
    struct Case {
        int type;
        int points;
        CellShape shape;
    };
    for (const auto& [type, points, shape] :
         {Case{VTK_QUADRATIC_TETRA, 10, CellShape::tetrahedron}, Case{VTK_QUADRATIC_PYRAMID, 13, CellShape::pyramid},
          Case{VTK_TRIQUADRATIC_PYRAMID, 19, CellShape::pyramid}, Case{VTK_QUADRATIC_WEDGE, 15, CellShape::wedge},
          Case{VTK_QUADRATIC_LINEAR_WEDGE, 12, CellShape::wedge},
          Case{VTK_BIQUADRATIC_QUADRATIC_WEDGE, 18, CellShape::wedge},
          Case{VTK_QUADRATIC_HEXAHEDRON, 20, CellShape::hexahedron},
          Case{VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON, 24, CellShape::hexahedron},
          Case{VTK_TRIQUADRATIC_HEXAHEDRON, 27, CellShape::hexahedron},
          Case{VTK_LAGRANGE_TETRAHEDRON, 10, CellShape::tetrahedron},
          Case{VTK_LAGRANGE_HEXAHEDRON, 27, CellShape::hexahedron}, Case{VTK_LAGRANGE_WEDGE, 18, CellShape::wedge},
          Case{VTK_BEZIER_TETRAHEDRON, 10, CellShape::tetrahedron}}) {
        const MeshFile file = read(cell_of(type, points));
        EXPECT_THAT(file.mesh.shapes, ElementsAre(shape)) << type;
        EXPECT_EQ(file.mesh.points.size(), static_cast<std::size_t>(vertex_count(shape)));
        EXPECT_THAT(file.notes,
                    ElementsAre("1 cells of higher order taken by their corners",
                                fmt::format("{} points that no cell uses left out", points - vertex_count(shape))));
    }
}

TEST(CellKinds, RefusesWhatHasNoShape)
{
    VtuText vtu = cell_of(VTK_HEXAHEDRON, 8);
    vtu.cells.push_back({VTK_PARAMETRIC_TETRA_REGION, {0, 1, 2, 3}});
    EXPECT_THAT(reading_error(folder.write("mesh.vtu", vtu.str())), HasSubstr("cell 1: there is no shape for a "));
}

TEST(CellKinds, CutsAPrismBesideAHexahedronAlikeOnBothSides)
{
    // A regular prism over a pentagon or hexagon, and a hexahedron on its last side: whatever way round the points are
    // numbered, each triangle inside the mesh has two tetrahedra.
    for (const auto& [type, sides] : {std::pair{VTK_PENTAGONAL_PRISM, 5}, {VTK_HEXAGONAL_PRISM, 6}})
        for (int turn = 0; turn < sides; ++turn) {
            VtuText vtu;
            std::vector<int> prism;
            const auto number = [&](int i, int level) { return (i + turn) % sides + level * sides; };
            vtu.points.resize(static_cast<std::size_t>(2 * sides + 4));
            for (int level = 0; level < 2; ++level)
                for (int i = 0; i < sides; ++i) {
                    const double angle = 2 * 3.14159 * i / sides;
                    vtu.points[static_cast<std::size_t>(number(i, level))] = {std::cos(angle), std::sin(angle),
                                                                              double(level)};
                    prism.push_back(number(i, level));
                }
            for (int level = 0; level < 2; ++level)
                for (int i = 0; i < 2; ++i) {
                    const auto& p = vtu.points[static_cast<std::size_t>(number(i, level))];
                    vtu.points[static_cast<std::size_t>(2 * sides + 2 * level + i)] = {p[0] + 2, p[1] + 2, p[2]};
                }
            const int outer = 2 * sides;
            vtu.cells = {
                {type, prism},
                {VTK_HEXAHEDRON,
                 {number(0, 0), outer, outer + 1, number(1, 0), number(0, 1), outer + 2, outer + 3, number(1, 1)}}};
            const MeshFile file = read(vtu);
            EXPECT_EQ(std::count(file.file_cells.begin(), file.file_cells.end(), 1u), 1);
            EXPECT_THAT(file.notes, ElementsAre("1 prisms, convex point sets and polyhedra cut into tetrahedra"));

            const Scene scene(subdivide(file.mesh).mesh);
            EXPECT_EQ(scene.traits().inverted_cells, 0u);
            EXPECT_TRUE(scene.traits().face_to_face);
            // Outside: two ends as fans, and two triangles for each side and end of the hexahedron that is not inside.
            EXPECT_EQ(scene.boundary().faces.size(), static_cast<std::size_t>(2 * (sides - 2) + 2 * (sides - 1) + 10))
                << sides << " sides, turned by " << turn;
        }
}

TEST(CellKinds, CutsTheConvexHullOfItsPoints)
{
    // The corners of a cube, and points in its middle, on an edge and on a face, which are no corners.
    VtuText vtu;
    for (int i = 0; i < 8; ++i)
        vtu.points.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
    vtu.points.insert(vtu.points.end(), {{0.5, 0.5, 0.5}, {0.5, 0, 0}, {0.5, 0.5, 0}});
    vtu.cells = {{VTK_CONVEX_POINT_SET, {10, 3, 7, 1, 0, 9, 2, 4, 8, 6, 5}}};
    const Scene scene(read(vtu).mesh);
    EXPECT_EQ(scene.traits().inverted_cells, 0u);
    EXPECT_EQ(scene.boundary().faces.size(), 12u);
    EXPECT_TRUE(scene.traits().convex);
    EXPECT_EQ(scene.mesh().points.size(), 8u);
}

TEST(CellKinds, LeavesOutAConvexPointSetWithoutVolume)
{
    VtuText vtu = square();
    vtu.points.push_back({0.5, 0.5, 1});
    vtu.cells = {{VTK_CONVEX_POINT_SET, {0, 1, 2, 3}}, {VTK_PYRAMID, {0, 1, 2, 3, 4}}};
    const MeshFile file = read(vtu);
    EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::pyramid));
    EXPECT_THAT(file.file_cells, ElementsAre(1));
    EXPECT_THAT(file.notes, ElementsAre("1 convex point sets without volume left out"));
}

TEST(CellKinds, LeavesOutSurfacesAndLinesBesideSolids)
{
    VtuText vtu = cell_of(VTK_TETRA, 4);
    vtu.cells.push_back({VTK_TRIANGLE, {0, 1, 2}});
    vtu.cells.push_back({VTK_QUAD, {0, 1, 2, 3}});
    vtu.cells.push_back({VTK_VERTEX, {0}});
    vtu.cells.push_back({VTK_LINE, {0, 1}});
    vtu.cells.push_back({VTK_QUADRATIC_EDGE, {0, 1, 2}});
    const MeshFile file = read(vtu);
    EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::tetrahedron));
    EXPECT_THAT(file.notes, ElementsAre("2 surface cells beside the solids left out", "3 vertices and lines left out"));
}

TEST(CellKinds, MakesASurfaceOfSurfaceCells)
{
    VtuText vtu = square();
    vtu.cells = {{VTK_TRIANGLE, {0, 1, 2}}, {VTK_LINE, {0, 1}}, {VTK_QUAD, {0, 1, 2, 3}}};
    const MeshFile file = read(vtu);
    EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::triangle, CellShape::triangle, CellShape::triangle));
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 1, 2, 0, 2, 3));
    EXPECT_THAT(file.notes, ElementsAre("1 polygons split into triangles", "1 vertices and lines left out"));
}

TEST(CellKinds, ReordersAPixel)
{
    VtuText vtu = square();
    std::swap(vtu.points[2], vtu.points[3]);
    vtu.cells = {{VTK_PIXEL, {0, 1, 2, 3}}};
    EXPECT_THAT(read(vtu).mesh.vertices, ElementsAre(0, 1, 3, 0, 3, 2));
}

TEST(CellKinds, SplitsAStripInOneOrientation)
{
    VtuText vtu = square();
    vtu.points.push_back({2, 0, 0});
    vtu.cells = {{VTK_TRIANGLE_STRIP, {0, 1, 3, 2, 4}}};
    EXPECT_THAT(read(vtu).mesh.vertices, ElementsAre(0, 1, 3, 3, 1, 2, 3, 2, 4));
}

TEST(CellKinds, TakesTheCornersOfQuadraticSurfaceCells)
{
    const MeshFile file = read(cell_of(VTK_QUADRATIC_TRIANGLE, 6));
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2));
    EXPECT_THAT(file.notes, Contains("1 cells of higher order taken by their corners"));
}

TEST(CellKinds, RefusesAPolygonOfTwoPoints)
{
    EXPECT_EQ(reading_error(folder.write("mesh.vtu", cell_of(VTK_POLYGON, 2).str())),
              "cell 0: a vtkPolygon with 2 points");
}
