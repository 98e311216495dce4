#include "tests/reading_error.h"
#include "tests/temporary_folder.h"

#include <gmock/gmock.h>

using namespace visorder;
using namespace visorder::tests;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

const TemporaryFolder folder;

std::filesystem::path written(const std::string& data_set, const std::string& version = "3.0")
{
    return folder.write("mesh.vtk", "# vtk DataFile Version " + version + "\ntitle\nASCII\n" + data_set);
}

const std::string tetrahedron = R"(DATASET UNSTRUCTURED_GRID
POINTS 4 double
0 0 0  1 0 0  0 1 0  0 0 1
CELLS 1 5
4 0 1 2 3
CELL_TYPES 1
10
)";

} // namespace

TEST(Legacy, ReadsAnUnstructuredGrid)
{
    const MeshFile file = read_mesh(written(tetrahedron));
    EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::tetrahedron));
    EXPECT_THAT(file.mesh.cell(0), ElementsAre(0, 1, 2, 3));
    EXPECT_EQ(file.mesh.points[3], glm::dvec3(0, 0, 1));
    EXPECT_THAT(file.notes, IsEmpty());
}

TEST(Legacy, ReadsTheFormatOfVersionFive)
{
    const MeshFile file = read_mesh(written(R"(DATASET UNSTRUCTURED_GRID
POINTS 4 float
0 0 0  1 0 0  0 1 0  0 0 1
CELLS 2 4
OFFSETS vtktypeint64
0 4
CONNECTIVITY vtktypeint64
0 1 2 3
CELL_TYPES 1
10
)",
                                            "5.1"));
    EXPECT_THAT(file.mesh.cell(0), ElementsAre(0, 1, 2, 3));
}

TEST(Legacy, ReadsEveryScalarOfTheFile)
{
    const auto path = written(tetrahedron + R"(POINT_DATA 4
SCALARS first float 1
LOOKUP_TABLE default
1 2 3 4
SCALARS second float 1
LOOKUP_TABLE default
5 6 7 8
FIELD FieldData 1
third 1 4 double
9 10 11 12
CELL_DATA 1
SCALARS fourth double 1
LOOKUP_TABLE default
13
)");
    EXPECT_EQ(read_mesh(path).scalar, "first");
    EXPECT_THAT(read_mesh(path, {.scalar = "second"}).mesh.scalars, ElementsAre(5, 6, 7, 8));
    EXPECT_THAT(read_mesh(path, {.scalar = "third"}).mesh.scalars, ElementsAre(9, 10, 11, 12));
    EXPECT_THAT(read_mesh(path, {.scalar = "fourth"}).mesh.scalars, ElementsAre(13, 13, 13, 13));
    EXPECT_EQ(reading_error(path, {.scalar = "fifth"}),
              "no scalar \"fifth\"; it has: first, second, third, fourth (of cells)");
}

TEST(Legacy, MakesHexahedraOfGrids)
{
    for (const std::string grid : {"DATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nORIGIN 0 0 0\nSPACING 1 1 1\n",
                                   "DATASET RECTILINEAR_GRID\nDIMENSIONS 3 2 2\nX_COORDINATES 3 float\n0 1 2\n"
                                   "Y_COORDINATES 2 float\n0 1\nZ_COORDINATES 2 float\n0 1\n",
                                   "DATASET STRUCTURED_GRID\nDIMENSIONS 3 2 2\nPOINTS 12 float\n"
                                   "0 0 0 1 0 0 2 0 0  0 1 0 1 1 0 2 1 0  0 0 1 1 0 1 2 0 1  0 1 1 1 1 1 2 1 1\n"}) {
        const MeshFile file = read_mesh(written(grid));
        EXPECT_THAT(file.mesh.points, SizeIs(12)) << grid;
        EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::hexahedron, CellShape::hexahedron)) << grid;
        EXPECT_EQ(file.mesh.points[5], glm::dvec3(2, 1, 0)) << grid;
        EXPECT_THAT(file.mesh.cell(1), ElementsAre(1, 2, 5, 4, 7, 8, 11, 10)) << grid;
        EXPECT_THAT(file.notes, IsEmpty()) << grid;
    }
}

TEST(Legacy, MakesASurfaceOfAFlatGrid)
{
    const MeshFile file =
        read_mesh(written("DATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 1\nORIGIN 0 0 0\nSPACING 1 1 1\n"));
    EXPECT_THAT(file.mesh.shapes, SizeIs(4));
    EXPECT_THAT(file.mesh.shapes, Each(CellShape::triangle));
}

TEST(Legacy, MakesASurfaceOfPolygons)
{
    const MeshFile file = read_mesh(written(R"(DATASET POLYDATA
POINTS 5 float
0 0 0  1 0 0  1 1 0  0 1 0  2 0 0
LINES 1 3
2 0 1
POLYGONS 2 9
4 0 1 2 3
3 1 4 2
)"));
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 2, 3, 1, 4, 2));
    EXPECT_THAT(file.notes, ElementsAre("1 polygons split into triangles", "1 vertices and lines left out"));
}

TEST(Legacy, RefusesDamagedFiles)
{
    EXPECT_EQ(reading_error(folder.write("text.vtk", "hello")), "cannot be read: not a legacy VTK file");
    EXPECT_EQ(reading_error(folder.write("empty.vtk", "")), "cannot be read: not a legacy VTK file");
    EXPECT_THAT(reading_error(written("")), HasSubstr("cannot be read"));
    EXPECT_THAT(reading_error(written("DATASET NOTHING\n")), HasSubstr("cannot be read"));
    EXPECT_THAT(reading_error(written("DATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0")),
                HasSubstr("cannot be read"));
    EXPECT_EQ(reading_error(written("DATASET UNSTRUCTURED_GRID\nPOINTS 1 float\n0 0 0\n")), "there are no cells in it");
    for (const std::string cut : {"CELLS", "4 0 1 2 3", "CELL_TYPES", "10\n"})
        EXPECT_NE(reading_error(written(tetrahedron.substr(0, tetrahedron.find(cut)))), "") << cut;
    EXPECT_NE(reading_error(written("DATASET STRUCTURED_GRID\nDIMENSIONS 3 2 2\nPOINTS 1 float\n0 0 0\n")), "");
    EXPECT_NE(reading_error(written("DATASET RECTILINEAR_GRID\nDIMENSIONS 3 2 2\nX_COORDINATES 2 float\n0 1\n"
                                    "Y_COORDINATES 2 float\n0 1\nZ_COORDINATES 2 float\n0 1\n")),
              "");
    EXPECT_NE(reading_error(written("DATASET STRUCTURED_POINTS\nDIMENSIONS 60000 60000 60000\n"
                                    "ORIGIN 0 0 0\nSPACING 1 1 1\n")),
              "");
}

TEST(Legacy, RefusesBinaryFilesCutShort)
{
    std::string binary = "# vtk DataFile Version 3.0\ntitle\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n";
    const std::string zero(4, '\0');
    const std::string one("\x3f\x80\0\0", 4);
    for (const auto& value : {zero, zero, zero, one, zero, zero, zero, one, zero, zero, zero, one})
        binary += value;
    binary += "\nCELLS 1 5\n";
    for (const char value : {'\4', '\0', '\1', '\2', '\3'})
        binary += std::string(3, '\0') + value;
    binary += "\nCELL_TYPES 1\n" + std::string(3, '\0') + '\x0a';
    EXPECT_EQ(read_mesh(folder.write("binary.vtk", binary + '\n')).mesh.cell_count(), 1u);
    const ReadOptions here{.isolated = false}; // a process for each would take long
    for (std::size_t length = binary.find("CELLS") - 20; length < binary.size(); ++length)
        EXPECT_NE(reading_error(folder.write("cut.vtk", binary.substr(0, length)), here), "") << length;
}
