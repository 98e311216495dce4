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

MeshFile read(const std::string& text)
{
    return read_mesh(folder.write("model.off", text));
}

std::string error_of(const std::string& text)
{
    return reading_error(folder.write("model.off", text));
}

const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

} // namespace

TEST(Off, ReadsPolygons)
{
    for (const std::string head : {"OFF\n4 2 0\n", "OFF 4 2 0\n", "4 2 0\n", "OFF\n# made by hand\n\n4 2 0 # counts\n",
                                   "\xef\xbb\xbfOFF\r\n4 2 0\r\n"}) {
        const MeshFile file = read(head + square + "3 0 1 2\n4 0 1 2 3\n");
        EXPECT_THAT(file.mesh.points, SizeIs(4)) << head;
        EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 0, 1, 2, 0, 2, 3)) << head;
        EXPECT_THAT(file.file_cells, ElementsAre(0, 1, 1)) << head;
    }
}

TEST(Off, PassesOverColoursAndNormals)
{
    EXPECT_THAT(read("OFF\n3 1 0\n0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2 0.5 0.5 0.5\n").mesh.vertices,
                ElementsAre(0, 1, 2));
    EXPECT_THAT(read("STCNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0 0 1 1 1 1 1 0 0\n0 1 0 0 0 1 1 1 1 1 0 0\n"
                     "3 0 1 2\n")
                    .mesh.vertices,
                ElementsAre(0, 1, 2));
}

TEST(Off, ReadsBinary)
{
    for (const bool normals : {false, true}) {
        ByteWriter bytes(std::endian::big);
        bytes.text(normals ? "NOFF BINARY\n" : "OFF BINARY\n").put_all<std::int32_t>(3, 1, 0);
        for (int i = 0; i < 3; ++i) {
            bytes.put_all<float>(i == 1, i == 2, 0);
            if (normals)
                bytes.put_all<float>(0, 0, 1);
        }
        bytes.put_all<std::int32_t>(3, 0, 1, 2, 4).put_all<float>(1, 0, 0, 1);
        const MeshFile file = read(bytes.bytes());
        EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2));
        EXPECT_EQ(file.mesh.points[1], glm::dvec3(1, 0, 0));
        for (std::size_t length = 0; length < bytes.bytes().size(); ++length)
            EXPECT_NE(error_of(bytes.bytes().substr(0, length)), "") << length;
    }
}

TEST(Off, NamesTheLineAtFault)
{
    EXPECT_EQ(error_of("hello\n"), "line 1: not an OFF file of points with three coordinates");
    EXPECT_EQ(error_of("4OFF\n"), "line 1: not an OFF file of points with three coordinates");
    EXPECT_EQ(error_of("OFF\n4 x 0\n" + square), "line 2: \"x\" is not a number that can be taken here");
    EXPECT_EQ(error_of("OFF\n99999999999 1 0\n"),
              "line 2: the number of points is 99999999999, more than the rest of the file has room for");
    EXPECT_EQ(error_of("OFF\n-1 1 0\n"), "line 2: the number of points is -1");
    EXPECT_EQ(error_of("OFF\n4 1 0\n" + square + "3 0 1 x\n"), "line 7: \"x\" is not a number that can be taken here");
    EXPECT_EQ(error_of("OFF\n4 1 0\n" + square + "3 0 1 4\n"), "cell 0: there is no point 4");
    EXPECT_EQ(error_of("OFF\n4 1 0\n" + square + "3 0 1 -1\n"), "cell 0: there is no point -1");
    EXPECT_EQ(error_of("OFF\n4 1 0\n" + square + "3 0 1"), "line 7: the file ends where a face's corner should be");
    EXPECT_EQ(error_of("OFF\n4 0 0\n" + square), "there are no cells in it");
    EXPECT_EQ(error_of("OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n"),
              "cell 0: coordinates of point 1 are not finite");
    EXPECT_THAT(error_of(""), HasSubstr("the file ends where the word OFF should be"));
}
