#include "tests/reading_error.h"
#include "tests/temporary_folder.h"
#include "visorder/scene.h"

#include <gmock/gmock.h>

using namespace visorder;
using namespace visorder::tests;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

namespace {

const TemporaryFolder folder;

MeshFile read(const std::string& text)
{
    return read_mesh(folder.write("mesh.mesh", text));
}

std::string error_of(const std::string& text)
{
    return reading_error(folder.write("mesh.mesh", text));
}

// A unit cube, a pyramid on it, and a prism and a tetrahedron beside it.
const std::string points = "Vertices\n13\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n1 1 1 0\n0 1 1 0\n"
                           "0.5 0.5 2 0\n2 0 0 0\n2 0 1 0\n3 1 0 0\n9 9 9 0\n";
const std::string head = "MeshVersionFormatted 2\nDimension 3\n" + points;

} // namespace

TEST(Medit, ReadsSolidsInVtksOrder)
{
    const MeshFile file = read(head + "Corners\n2\n1\n2\nTriangles 1\n1 2 3 7\nEdges 1\n1 2 7\n"
                                      "Hexahedra\n1\n1 2 3 4 5 6 7 8 1\nPyramids 1 5 6 7 8 9 1\n"
                                      "Prisms 1 2 10 3 6 11 7 1\nTetrahedra 1 10 12 3 11 1\nEnd\n");
    EXPECT_THAT(file.mesh.shapes,
                ElementsAre(CellShape::hexahedron, CellShape::pyramid, CellShape::wedge, CellShape::tetrahedron));
    EXPECT_THAT(file.mesh.cell(2), ElementsAre(1, 2, 9, 5, 6, 10));
    EXPECT_THAT(file.file_cells, ElementsAre(2, 3, 4, 5));
    EXPECT_THAT(file.notes, Contains("1 surface cells beside the solids left out"));
    EXPECT_THAT(file.notes, Contains("1 vertices and lines left out"));
    const Scene scene(file.mesh);
    EXPECT_EQ(scene.traits().inverted_cells, 0u);
    EXPECT_EQ(scene.traits().flat_cells, 0u);
}

TEST(Medit, ReadsSurfacesInThePlane)
{
    const MeshFile file = read("MeshVersionFormatted\n1\n# a comment\nDimension\n2\nVertices 4\n0 0 1\n1 0 1\n1 1 1\n"
                               "0 1 1\nQuadrilaterals 1\n1 2 3 4 1\nRequiredVertices 1 2\nNormals 1 0 0 1\nEnd");
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 2, 3));
    EXPECT_EQ(file.mesh.points[2], glm::dvec3(1, 1, 0));
}

TEST(Medit, TakesTheCornersOfCellsOfHigherOrder)
{
    const MeshFile file = read("MeshVersionFormatted 3 Dimension 3 Vertices 10 0 0 0 0 1d0 0 0 0 0 1D+00 0 0 0 0 1 0 "
                               ".5 0 0 0 .5 .5 0 0 0 .5 0 0 0 0 .5 0 .5 0 .5 0 0 .5 .5 0 TetrahedraP2 1 "
                               "1 2 3 4 5 6 7 8 9 10 0 End");
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(file.notes, Contains("1 cells of higher order taken by their corners"));
}

TEST(Medit, NamesTheLineAtFault)
{
    EXPECT_EQ(error_of("MFEM mesh v1.0\n"), "line 1: not a MEDIT mesh in text, which begins with MeshVersionFormatted");
    EXPECT_EQ(error_of("MeshVersionFormatted 2\nDimension 4\n"), "line 2: points of 4 coordinates");
    EXPECT_EQ(error_of(head + "Tetrahedra\n1\n1 2 3 0 0\n"), "line 20: there is no point 0, they are counted from 1");
    EXPECT_EQ(error_of(head + "Tetrahedra\n1\n1 2 3 14 0\n"), "cell 0: there is no point 13");
    EXPECT_EQ(error_of(head + "Tetrahedra\n1\n1 2 3\n"), "line 21: the file ends where a cell's point should be");
    EXPECT_EQ(error_of(head + "Tetrahedra\n100000000000\n1 2 3 4 0\n"),
              "line 19: the number of cells is 100000000000, more than the rest of the file has room for");
    EXPECT_EQ(error_of(head + points), "line 19: a second list of points");
    EXPECT_EQ(error_of(head + "Tetrahedra x\n"), "line 18: \"x\" is not a number that can be taken here");
    EXPECT_EQ(error_of(head + "End\n"), "there are no cells in it");
    EXPECT_THAT(reading_error(folder.write("mesh.meshb", "abc")), HasSubstr("a MEDIT mesh in binary is not read"));
}

TEST(Medit, ReadsRealMeshes)
{
    struct Model {
        const char* name;
        std::size_t points;
        CellShape shape;
        std::size_t cells;
        std::size_t inverted;
    };
    for (const auto& [name, points, shape, cells, inverted] :
         {Model{"elbow2.mesh", 1823, CellShape::tetrahedron, 8161, 8161},
          Model{"cino_ellipsoid.mesh", 7293, CellShape::hexahedron, 6816, 0}}) {
        const auto path = std::filesystem::path(VISORDER_DATA_DIR) / "volumes" / name;
        if (!std::filesystem::exists(path))
            GTEST_SKIP() << "needs " << path;
        const MeshFile file = read_mesh(path);
        EXPECT_EQ(file.mesh.points.size(), points) << name;
        EXPECT_THAT(file.mesh.shapes, SizeIs(cells)) << name;
        EXPECT_THAT(file.mesh.shapes, testing::Each(shape)) << name;
        EXPECT_EQ(Scene(file.mesh).traits().inverted_cells, inverted) << name;
    }
}
