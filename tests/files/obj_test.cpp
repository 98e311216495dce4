#include "tests/reading_error.h"
#include "tests/temporary_folder.h"

#include <gmock/gmock.h>

using namespace visorder;
using namespace visorder::tests;
using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

const TemporaryFolder folder;

MeshFile read(const std::string& text)
{
    return read_mesh(folder.write("model.obj", text));
}

std::string error_of(const std::string& text, const ReadOptions& options = {})
{
    return reading_error(folder.write("model.obj", text), options);
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

} // namespace

TEST(Obj, ReadsTriangles)
{
    const MeshFile file = read(square + "f 1 2 3\nf 1 3 4\n");
    EXPECT_THAT(file.mesh.points,
                ElementsAre(glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0), glm::dvec3(0, 1, 0)));
    EXPECT_THAT(file.mesh.shapes, Each(CellShape::triangle));
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 2, 3));
    EXPECT_THAT(file.mesh.scalars, IsEmpty());
    EXPECT_THAT(file.notes, IsEmpty());
}

TEST(Obj, SharesPointsWhateverTheirTextureAndNormal)
{
    const std::string looks = "vt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\n";
    for (const std::string faces : {"f 1/1 2/1 3/1\nf 1/2 3/2 4/2\n", "f 1//1 2//1 3//1\nf 1//2 3//2 4//2\n",
                                    "f 1/1/1 2/1/1 3/1/1\nf 1/2/2 3/2/2 4/2/2\n"}) {
        const MeshFile file = read(square + looks + faces);
        EXPECT_THAT(file.mesh.points, SizeIs(4)) << faces;
        EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 2, 3)) << faces;
    }
}

TEST(Obj, CountsBackFromTheLastPoint)
{
    EXPECT_THAT(read("v 9 9 9\n" + square + "f -4 -3 -2\nf -4//-1 -2//-1 -1//-1\nf 1 2 3\n").mesh.vertices,
                ElementsAre(1, 2, 3, 1, 3, 4, 0, 1, 2));
}

TEST(Obj, SplitsPolygons)
{
    const MeshFile file = read(square + "f 1 2 3 4\nf 1 2 3\n");
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 2, 3, 0, 1, 2));
    EXPECT_THAT(file.notes, ElementsAre("1 polygons split into triangles"));
}

TEST(Obj, ReadsWhatOtherProgramsWrite)
{
    const MeshFile file =
        read("####\n# model\r\n\r\nmtllib a.mtl\no thing\nv  0 0 0 1.0\r\n\tv 1e0 +0 -0.0 0.5 0.5 0.5\n"
             "v 0 1 0 # a point\ng\ns off\nusemtl red\nf 1 \\\n 2 3 \n");
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2));
    EXPECT_EQ(file.mesh.points[1], glm::dvec3(1, 0, 0));
}

TEST(Obj, PassesOverAByteOrderMark)
{
    EXPECT_THAT(read("\xef\xbb\xbf" + square + "f 1 2 3\n").mesh.vertices, ElementsAre(0, 1, 2));
    EXPECT_THAT(read("\xef\xbb\xbf# model\n" + square + "f 1 2 3\n").mesh.vertices, ElementsAre(0, 1, 2));
}

TEST(Obj, GoesOnInTheNextLineWhateverEndsIt)
{
    for (const std::string end : {"\n", "\r\n", "  \n", " \r\n"})
        EXPECT_THAT(read(square + "f 1 \\" + end + "2 \\" + end + "3" + end).mesh.vertices, ElementsAre(0, 1, 2));
}

TEST(Obj, TakesBlanksAtTheEndOfLinesAndOfTheFile)
{
    EXPECT_THAT(read(square + "f 1 2 3 \t \r\n" + std::string(5000, '\n') + std::string(5000, ' ')).mesh.vertices,
                ElementsAre(0, 1, 2));
    EXPECT_THAT(read(square + "f 1 2 3").mesh.vertices, ElementsAre(0, 1, 2));
}

TEST(Obj, LeavesOutFreeFormSurfacesWithANote)
{
    const MeshFile file = read(square + "f 1 2 3\ncstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 1\nend\n");
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2));
    EXPECT_THAT(file.notes,
                ElementsAre("1 free-form curves and surfaces left out", "1 points that no cell uses left out"));
}

TEST(Obj, NumbersCellsAsTheFileListsThem)
{
    EXPECT_THAT(read(square + "l 1 2\nf 1 2 3 4\np 1\nf 1 2 3\n").file_cells, ElementsAre(1, 1, 3));
}

TEST(Obj, LeavesOutPointsAndLines)
{
    const MeshFile file = read(square + "v 5 5 5\np 1\nl 1 2 5\nf 1 2 3 4\n");
    EXPECT_THAT(file.mesh.points, SizeIs(4));
    EXPECT_THAT(file.notes, ElementsAre("1 polygons split into triangles", "2 vertices and lines left out",
                                        "1 points that no cell uses left out"));
}

TEST(Obj, NamesTheLineAtFault)
{
    EXPECT_EQ(error_of("v 0 0\n"), "line 1: a point needs three coordinates");
    EXPECT_EQ(error_of("v 0 0 x\n"), "line 1: \"x\" is not a number that can be taken here");
    EXPECT_EQ(error_of("v 0 0 nan\n"), "line 1: a coordinate is not finite");
    EXPECT_EQ(error_of("v 0 0 1e999\n"), "line 1: \"1e999\" is not a number that can be taken here");
    EXPECT_EQ(error_of(square + "f 1 2\n"), "line 5: a polygon of 2 corners");
    EXPECT_EQ(error_of(square + "f 1 2 5\n"), "line 5: there is no point 5, 4 came before");
    EXPECT_EQ(error_of(square + "f 1 2 0\n"), "line 5: there is no point 0, 4 came before");
    EXPECT_EQ(error_of(square + "f 1 2 -5\n"), "line 5: there is no point -5, 4 came before");
    EXPECT_EQ(error_of(square + "f 1 2 3.5\n"), "line 5: \"3.5\" is not a number that can be taken here");
    EXPECT_EQ(error_of(square + "f 1 2 /3\n"), "line 5: \"\" is not a number that can be taken here");
    EXPECT_EQ(error_of(square + "hello\n"), "line 5: \"hello\" is nothing that a polygon model has");
    EXPECT_EQ(error_of(square + "f 1 2 \\"), "line 5: the file ends within it");
    EXPECT_EQ(error_of(std::string("\x80\x01\xff", 3)), "line 1: \"???\" is nothing that a polygon model has");
}

TEST(Obj, RefusesAModelWithoutPolygons)
{
    EXPECT_EQ(error_of(""), "there are no polygons in it");
    EXPECT_EQ(error_of(square + "l 1 2\n"), "there are no polygons in it");
}

TEST(Obj, HasNoScalars)
{
    EXPECT_EQ(error_of(square + "f 1 2 3\n", {.scalar = "height"}), "no scalar \"height\"; it has: none");
}
