#include "tests/files/byte_writer.h"
#include "tests/reading_error.h"
#include "tests/temporary_folder.h"

#include <gmock/gmock.h>

using namespace visorder;
using namespace visorder::tests;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

const TemporaryFolder folder;

MeshFile read(const std::string& text)
{
    return read_mesh(folder.write("model.stl", text));
}

std::string error_of(const std::string& text)
{
    return reading_error(folder.write("model.stl", text));
}

std::string facet(const std::string& a, const std::string& b, const std::string& c)
{
    return "  facet normal 0 0 1\n    outer loop\n      vertex " + a + "\n      vertex " + b + "\n      vertex " + c +
           "\n    endloop\n  endfacet\n";
}

const std::string square = facet("0 0 0", "1 0 0", "1 1 0") + facet("0 0 0", "1 1 0", "-0 1 0");

std::string binary(const std::string& header, std::uint32_t triangles)
{
    ByteWriter bytes;
    std::string padded = header;
    padded.resize(80, ' ');
    bytes.text(padded).put(triangles);
    for (std::uint32_t i = 0; i < triangles; ++i) {
        bytes.put_all<float>(0, 0, 1);
        bytes.put_all<float>(i, 0, 0).put_all<float>(i + 1, 0, 0).put_all<float>(i, 1, 0);
        bytes.put<std::uint16_t>(7);
    }
    return bytes.bytes();
}

} // namespace

TEST(Stl, JoinsEqualPointsOfATextFile)
{
    const MeshFile file = read("solid a square\n" + square + "endsolid a square\n");
    EXPECT_THAT(file.mesh.points, SizeIs(4));
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 2, 3));
    EXPECT_THAT(file.blocks, IsEmpty());
    EXPECT_THAT(file.notes, IsEmpty());
}

TEST(Stl, ReadsWhatOtherProgramsWrite)
{
    std::string text =
        "SOLID\r\nFACET NORMAL -nan(ind) 1.#QNAN 0\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX 1.0E+00 0 0\r\n"
        "VERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID\r\n   \r\n";
    EXPECT_THAT(read(text).mesh.vertices, ElementsAre(0, 1, 2));
}

TEST(Stl, NamesTheSolidsOfATextFile)
{
    const MeshFile file =
        read("solid\n" + square + "endsolid\nsolid right\n" + facet("1 0 0", "2 0 0", "1 1 0") + "endsolid right\n");
    EXPECT_THAT(file.mesh.points, SizeIs(5));
    ASSERT_THAT(file.blocks, SizeIs(2));
    EXPECT_EQ(file.blocks[0].name, "solid 0");
    EXPECT_EQ(file.blocks[1].name, "right");
    EXPECT_EQ(file.blocks[1].first_file_cell, 2u);
}

TEST(Stl, ReadsBinary)
{
    for (const std::string header : {"made by hand", "solid made by hand", ""}) {
        const MeshFile file = read(binary(header, 3));
        EXPECT_THAT(file.mesh.points, SizeIs(7));
        EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 1, 3, 4, 3, 5, 6));
    }
}

TEST(Stl, RefusesBinaryCutShort)
{
    const std::string whole = binary("made by hand", 3);
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(error_of(whole.substr(0, length)), "") << length;
    EXPECT_EQ(error_of(whole.substr(0, 150)), "byte 84: 3 triangles are more than the rest of the file has room for");
}

TEST(Stl, NamesTheLineAtFault)
{
    EXPECT_EQ(error_of("hello"), "line 1: \"hello\" stands where solid should");
    EXPECT_EQ(error_of("solid a\nfacet\nnormal 0 0 1 outer loop vertex 0 0 x"),
              "line 3: \"x\" is not a number that can be taken here");
    EXPECT_EQ(error_of("solid a\n" + square), "line 16: the file ends where endsolid should be");
    EXPECT_EQ(error_of("solid a\n" + square + "hello\n"), "line 16: \"hello\" stands where endsolid should");
    EXPECT_EQ(error_of("solid a\nendsolid a\n"), "there are no cells in it");
    EXPECT_EQ(error_of(""), "there are no cells in it");
    EXPECT_THAT(error_of("solid\n" + facet("0 0 0", "inf 0 0", "0 1 0") + "endsolid\n"), HasSubstr("not finite"));
}
