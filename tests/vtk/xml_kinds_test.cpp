// VTK's XML files beside .vtu: other kinds of grids, files in pieces and files that name others.

#include "scene/boundary.h"
#include "tests/reading_error.h"
#include "tests/temporary_folder.h"
#include "visorder/scene.h"
#include "vtu_text.h"

#include <cmath>
#include <gmock/gmock.h>
#include <zlib.h>

using namespace visorder;
using namespace visorder::detail;
using namespace visorder::tests;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

namespace {

const TemporaryFolder folder;

std::string file_of(const std::string& type, const std::string& content)
{
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"0.1\" byte_order=\"LittleEndian\">\n" +
           content + "</VTKFile>\n";
}

std::string array(const std::string& attributes, const std::string& values)
{
    return "<DataArray type=\"Float64\" " + attributes + " format=\"ascii\">" + values + "</DataArray>\n";
}

const std::string heights = "<PointData>" + array("Name=\"height\"", "0 1 2 3 4 5 6 7 8 9 10 11") + "</PointData>";

/// 3 x 2 x 2 points.
std::string extent_of(const std::string& type, const std::string& more, const std::string& content)
{
    return file_of(type, "<" + type + " WholeExtent=\"0 2 0 1 0 1\" " + more + "><Piece Extent=\"0 2 0 1 0 1\">" +
                             heights + content + "</Piece></" + type + ">");
}

/// A tetrahedron on the side x < 0 or x > 0 of the triangle (0, 0, 0), (0, 1, 0), (0, 0, 1).
VtuText tetrahedron(double x)
{
    VtuText vtu;
    vtu.points = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x, 0, 0}};
    vtu.cells = {{10, {0, 1, 2, 3}}};
    if (x < 0)
        std::swap(vtu.cells[0].points[0], vtu.cells[0].points[1]);
    vtu.point_arrays = {{"T", 1, {1, 2, 3, x}}};
    return vtu;
}

std::string message_of(const std::filesystem::path& path, const ReadOptions& options = {})
{
    try {
        read_mesh(path, options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST(XmlKinds, ReadsGridsOfEveryKind)
{
    const std::string points = array("Name=\"Points\" NumberOfComponents=\"3\"", "0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0 "
                                                                                 "0 0 1 1 0 1 2 0 1 0 1 1 1 1 1 2 1 1");
    for (const auto& path :
         {folder.write("a.vts", extent_of("StructuredGrid", "", "<Points>" + points + "</Points>")),
          folder.write("a.vtr", extent_of("RectilinearGrid", "",
                                          "<Coordinates>" + array("Name=\"x\"", "0 1 2") + array("Name=\"y\"", "0 1") +
                                              array("Name=\"z\"", "0 1") + "</Coordinates>")),
          folder.write("A.VTI", extent_of("ImageData", "Origin=\"0 0 0\" Spacing=\"1 1 1\"", ""))}) {
        const MeshFile file = read_mesh(path);
        EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::hexahedron, CellShape::hexahedron)) << path;
        EXPECT_THAT(file.mesh.cell(1), ElementsAre(1, 2, 5, 4, 7, 8, 11, 10)) << path;
        EXPECT_EQ(file.mesh.points[11], glm::dvec3(2, 1, 1)) << path;
        EXPECT_EQ(file.scalar, "height") << path;
        EXPECT_EQ(file.mesh.scalars[7], 7) << path;
    }
}

TEST(XmlKinds, ReadsPolygons)
{
    const auto path = folder.write(
        "a.vtp",
        file_of("PolyData",
                "<PolyData><Piece NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                "NumberOfPolys=\"1\"><Points>" +
                    array("Name=\"Points\" NumberOfComponents=\"3\"", "0 0 0 1 0 0 1 1 0 0 1 0") +
                    "</Points><Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3"
                    "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4</DataArray></Polys>"
                    "</Piece></PolyData>"));
    EXPECT_THAT(read_mesh(path).mesh.vertices, ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(XmlKinds, JoinsThePiecesOfAFileAndKnowsWhichArraysEachHas)
{
    // The pieces of two files in one.
    VtuText right = tetrahedron(1), left = tetrahedron(-1);
    right.point_arrays.push_back({"only right", 1, {5, 6, 7, 8}});
    const std::string a = right.str(), b = left.str();
    const auto piece_of = [](const std::string& text) {
        const std::size_t begin = text.find("<Piece"), end = text.find("</Piece>");
        return text.substr(begin, end - begin + 8);
    };
    const auto path = folder.write("pieces.vtu", file_of("UnstructuredGrid", "<UnstructuredGrid>" + piece_of(a) +
                                                                                 piece_of(b) + "</UnstructuredGrid>"));
    const MeshFile file = read_mesh(path);
    EXPECT_THAT(file.mesh.points, SizeIs(5));
    EXPECT_THAT(file.mesh.scalars, ElementsAre(1, 2, 3, 1, -1));
    EXPECT_THAT(file.notes, Contains("3 points joined with those of other pieces at the same coordinates"));
    EXPECT_TRUE(Scene(file.mesh).traits().face_to_face);
    EXPECT_EQ(Scene(file.mesh).boundary().faces.size(), 6u);

    const MeshFile other = read_mesh(path, {.scalar = "only right"});
    EXPECT_EQ(other.mesh.scalars[3], 8);
    EXPECT_TRUE(std::isnan(other.mesh.scalars[4]));
}

TEST(XmlKinds, ReadsPiecesInFilesOfTheirOwn)
{
    VtuText left = tetrahedron(-1);
    left.cells.push_back({10, {0, 1, 2, 3}});
    left.cell_arrays = {{"vtkGhostType", 1, {0, 1}, "UInt8"}};
    folder.write("right.vtu", tetrahedron(1).str());
    folder.write("left.vtu", left.str());
    const auto write = [](const std::string& sources) {
        return folder.write("a.pvtu", file_of("PUnstructuredGrid", "<PUnstructuredGrid GhostLevel=\"0\"><PPoints>"
                                                                   "<PDataArray type=\"Float64\" NumberOfComponents="
                                                                   "\"3\"/></PPoints>" +
                                                                       sources + "</PUnstructuredGrid>"));
    };
    const MeshFile file = read_mesh(write("<Piece Source=\"right.vtu\"/><Piece Source=\"left.vtu\"/>"));
    EXPECT_THAT(file.mesh.points, SizeIs(5));
    EXPECT_THAT(file.file_cells, ElementsAre(0, 1));
    EXPECT_THAT(file.notes, Contains("1 hidden cells left out"));
    ASSERT_THAT(file.blocks, SizeIs(2));
    EXPECT_EQ(file.blocks[1].name, "left.vtu");
    EXPECT_EQ(file.blocks[1].first_file_cell, 1u);

    const auto missing = write("<Piece Source=\"right.vtu\"/><Piece Source=\"middle.vtu\"/>");
    EXPECT_EQ(reading_error(missing), "there is no file " + folder.file("middle.vtu").string() + ", which it names");
    EXPECT_THAT(message_of(write("<Piece Source=\"a.pvtu\"/>")), HasSubstr("is no kind of VTK file that can be taken"));
    EXPECT_EQ(reading_error(write("")), "it names no files");
}

TEST(XmlKinds, ReadsBlocksWithinBlocks)
{
    folder.write("right.vtu", tetrahedron(1).str());
    folder.write("left.vtu", tetrahedron(-1).str());
    const auto path = folder.write(
        "a.vtm", file_of("vtkMultiBlockDataSet",
                         "<vtkMultiBlockDataSet><Block index=\"0\" name=\"outer\"><DataSet index=\"0\" name=\"first\" "
                         "file=\"right.vtu\"/><DataSet index=\"1\"/></Block><DataSet index=\"1\" file=\"left.vtu\"/>"
                         "</vtkMultiBlockDataSet>"));
    const MeshFile file = read_mesh(path);
    EXPECT_THAT(file.mesh.points, SizeIs(5));
    ASSERT_THAT(file.blocks, SizeIs(2));
    EXPECT_EQ(file.blocks[0].name, "outer/first");
    EXPECT_EQ(file.blocks[1].name, "1");
    EXPECT_EQ(file.blocks[1].first_file_cell, 1u);

    const auto itself = folder.write(
        "self.vtm", file_of("vtkMultiBlockDataSet",
                            "<vtkMultiBlockDataSet><DataSet index=\"0\" file=\"self.vtm\"/></vtkMultiBlockDataSet>"));
    EXPECT_THAT(message_of(itself), HasSubstr("is no kind of VTK file that can be taken as a part of"));
    std::string deep;
    for (int i = 0; i < 100; ++i)
        deep += "<Block>";
    for (int i = 0; i < 100; ++i)
        deep += "</Block>";
    EXPECT_EQ(reading_error(folder.write("deep.vtm", file_of("vtkMultiBlockDataSet", "<vtkMultiBlockDataSet>" + deep +
                                                                                         "</vtkMultiBlockDataSet>"))),
              "blocks lie within blocks more than 64 deep");
}

TEST(XmlKinds, ReadsTheTimeStepAskedForOfACollection)
{
    folder.write("right.vtu", tetrahedron(1).str());
    folder.write("left.vtu", tetrahedron(-1).str());
    const auto path = folder.write(
        "a.pvd", file_of("Collection", "<Collection><DataSet timestep=\"0\" part=\"0\" file=\"right.vtu\"/>"
                                       "<DataSet timestep=\"0.5\" part=\"0\" file=\"left.vtu\"/></Collection>"));
    EXPECT_EQ(read_mesh(path).mesh.points[3].x, -1);
    EXPECT_THAT(read_mesh(path).notes, ElementsAre("time step 1 (from 0) of 2, at time 0.5"));
    EXPECT_EQ(read_mesh(path, {.time = "0"}).mesh.points[3].x, 1);
    EXPECT_EQ(reading_error(path, {.time = "3"}), "no time \"3\"; its 2 time steps are at 0, 0.5");
}

TEST(XmlKinds, LeavesOutCellsAtHiddenPoints)
{
    VtuText vtu = vtu_of_two_tetrahedra();
    vtu.point_arrays = {{"vtkGhostType", 1, {0, 0, 0, 0, 2}, "UInt8"}};
    const MeshFile file = read_mesh(folder.write("hidden.vtu", vtu.str()));
    EXPECT_THAT(file.file_cells, ElementsAre(0));
    EXPECT_THAT(file.notes, Contains("1 hidden cells left out"));
}

TEST(XmlKinds, TakesBlanksAfterTheEnd)
{
    EXPECT_THAT(
        read_mesh(folder.write("blanks.vtu", vtu_of_two_tetrahedra().str() + std::string(200000, '\n'))).mesh.shapes,
        SizeIs(2));
}

TEST(XmlKinds, RefusesWhatIsNoMesh)
{
    EXPECT_EQ(reading_error(folder.write("a.vtu", "hello")), "cannot be read: not an XML file of VTK");
    EXPECT_EQ(reading_error(folder.write("a.vtu", file_of("Table", ""))),
              "\"Table\" is no kind of VTK file that a mesh can be made of");
    EXPECT_EQ(reading_error(folder.write("a.vtm.gz", "hello")),
              "files that end in .vtm are read only if they are not compressed");
}

TEST(XmlKinds, ReadsCompressedFilesOfOneGrid)
{
    const auto path = folder.file("packed.vtu.gz");
    const auto write = [&](const std::string& content) {
        gzFile file = gzopen(path.c_str(), "wb");
        gzwrite(file, content.data(), static_cast<unsigned>(content.size()));
        gzclose(file);
    };
    write(vtu_of_two_tetrahedra().str());
    EXPECT_THAT(read_mesh(path).mesh.shapes, Each(CellShape::tetrahedron));
    write("hello");
    EXPECT_EQ(reading_error(path), "cannot be read: not an XML file of VTK");
}
