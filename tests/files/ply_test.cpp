#include "tests/files/byte_writer.h"
#include "tests/reading_error.h"
#include "tests/temporary_folder.h"

#include <gmock/gmock.h>

using namespace visorder;
using namespace visorder::tests;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

namespace {

const TemporaryFolder folder;

MeshFile read(const std::string& text, const ReadOptions& options = {})
{
    return read_mesh(folder.write("model.ply", text), options);
}

std::string error_of(const std::string& text)
{
    return reading_error(folder.write("model.ply", text));
}

const std::string text_square =
    "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\nproperty uchar red\nproperty float quality\n"
    "element face 2\nproperty list uchar int vertex_indices\nproperty int group\nend_header\n"
    "0 0 0 9 0\n1 0 0 9 10\n1 1 0 9 20\n0 1 0 9 30\n3 0 1 2 4\n4 0 1 2 3 8\n";

std::string binary_square(std::endian order, const std::string& line_end = "\n")
{
    ByteWriter bytes(order);
    const std::string name = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    for (const std::string& line :
         {std::string("ply"), "format " + name + " 1.0", std::string("element edge 1"),
          std::string("property list ushort short of"), std::string("element face 2"),
          std::string("property uint8 flag"), std::string("property list uint8 uint32 vertex_index"),
          std::string("element vertex 4"), std::string("property double y"), std::string("property double x"),
          std::string("property int16 z"), std::string("property float32 quality"), std::string("end_header")})
        bytes.text(line + line_end);
    bytes.put_all<std::uint16_t>(2).put_all<std::int16_t>(-1, -2);
    bytes.put<std::uint8_t>(1).put<std::uint8_t>(3).put_all<std::uint32_t>(0, 1, 2);
    bytes.put<std::uint8_t>(1).put<std::uint8_t>(4).put_all<std::uint32_t>(0, 1, 2, 3);
    for (int i = 0; i < 4; ++i)
        bytes.put_all<double>(i > 1, i == 1 || i == 2).put<std::int16_t>(-5).put<float>(10.0f * static_cast<float>(i));
    return bytes.bytes();
}

} // namespace

TEST(Ply, ReadsText)
{
    const MeshFile file = read(text_square);
    EXPECT_THAT(file.mesh.points, SizeIs(4));
    EXPECT_EQ(file.mesh.points[2], glm::dvec3(1, 1, 0));
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 1, 2, 0, 2, 3));
    EXPECT_THAT(file.file_cells, ElementsAre(0, 1, 1));
    EXPECT_EQ(file.scalar, "quality");
    EXPECT_THAT(file.mesh.scalars, ElementsAre(0, 10, 20, 30));
    EXPECT_THAT(read(text_square, {.scalar = "red"}).mesh.scalars, ElementsAre(9, 9, 9, 9));
    EXPECT_THAT(read(text_square, {.scalar = "group"}).mesh.scalars, ElementsAre(6, 6, 6, 8));
}

TEST(Ply, ReadsBinaryOfBothByteOrdersWithFacesBeforePoints)
{
    for (const std::endian order : {std::endian::little, std::endian::big})
        for (const std::string line_end : {"\n", "\r\n"}) {
            const MeshFile file = read(binary_square(order, line_end));
            EXPECT_EQ(file.mesh.points[1], glm::dvec3(1, 0, -5));
            EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 1, 2, 0, 2, 3));
            EXPECT_THAT(file.mesh.scalars, ElementsAre(0, 10, 20, 30));
        }
}

TEST(Ply, ReadsStripsOfTriangles)
{
    const MeshFile file =
        read("ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
             "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
             "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n8 0 1 2 3 -1 1 4 3\n");
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 2, 1, 3, 1, 4, 3));
}

TEST(Ply, RefusesFilesCutShort)
{
    for (const std::string& whole : {text_square, binary_square(std::endian::little), binary_square(std::endian::big)})
        for (std::size_t length = 0; length + 2 < whole.size(); ++length)
            EXPECT_NE(error_of(whole.substr(0, length)), "") << length << " of " << whole.size();
}

TEST(Ply, NamesTheLineAtFault)
{
    const auto replaced = [](const std::string& what, const std::string& by) {
        std::string text = text_square;
        return text.replace(text.find(what), what.size(), by);
    };
    EXPECT_EQ(error_of("hello\n"), "line 1: not a PLY file");
    EXPECT_EQ(error_of(replaced("ascii", "klingon")), "line 2: \"klingon\" is no format of PLY");
    EXPECT_EQ(error_of(replaced("comment", "remark")), "line 3: \"remark\" is nothing that a PLY header has");
    EXPECT_EQ(error_of(replaced("float x", "real x")), "line 5: \"real\" is no type of a property");
    EXPECT_EQ(error_of(replaced("float x", "float u")), "line 14: points have no x");
    EXPECT_EQ(error_of(replaced("vertex_indices", "indices")), "line 17: faces have no vertex_indices");
    EXPECT_EQ(error_of(replaced("vertex 4", "vertex 4000000000")),
              "line 14: 4000000000 vertex elements are more than the rest of the file has room for");
    EXPECT_EQ(error_of(replaced("4 0 1 2 3 8", "4 0 1 2 9 8")), "cell 1: there is no point 9");
    EXPECT_EQ(error_of(replaced("3 0 1 2 4", "-3 0 1 2 4")), "line 18: a list of -3 numbers");
    EXPECT_EQ(error_of(replaced("3 0 1 2 4", "3 0 1.5 2 4")), "line 18: 1.5 is no number of a point");
    EXPECT_THAT(error_of(replaced("0 0 0 9 0", "0 0 0 9 x")), HasSubstr("\"x\" is not a number"));
}
