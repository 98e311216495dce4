#include "tests/reading_error.h"
#include "tests/temporary_folder.h"

#include <gmock/gmock.h>
#include <zlib.h>

using namespace visorder;
using namespace visorder::tests;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

const TemporaryFolder folder;

std::string compressed(const std::string& content)
{
    z_stream stream{};
    constexpr int gzip = 16 + MAX_WBITS;
    EXPECT_EQ(deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string result(deflateBound(&stream, content.size()), '\0');
    std::string input = content;
    stream.next_in = reinterpret_cast<Bytef*>(input.data());
    stream.avail_in = static_cast<uInt>(input.size());
    stream.next_out = reinterpret_cast<Bytef*>(result.data());
    stream.avail_out = static_cast<uInt>(result.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    result.resize(stream.total_out);
    deflateEnd(&stream);
    return result;
}

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

} // namespace

TEST(Gzip, IsReadByEveryReaderOfOurs)
{
    EXPECT_THAT(read_mesh(folder.write("a.obj.gz", compressed(triangle))).mesh.vertices, ElementsAre(0, 1, 2));
    EXPECT_THAT(
        read_mesh(folder.write("a.OFF.GZ", compressed("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"))).mesh.vertices,
        ElementsAre(0, 1, 2));
    // More than one buffer of it, and in two members.
    const std::string comments = "#" + std::string(300000, 'x') + "\n";
    EXPECT_THAT(read_mesh(folder.write("b.obj.gz", compressed(comments) + compressed(triangle))).mesh.vertices,
                ElementsAre(0, 1, 2));
    EXPECT_THAT(read_mesh(folder.write("c.obj.gz", compressed(triangle) + std::string(100, '\0'))).mesh.vertices,
                ElementsAre(0, 1, 2));
}

TEST(Gzip, NamesTheLineWithin)
{
    EXPECT_EQ(reading_error(folder.write("a.obj.gz", compressed("hello"))),
              "line 1: \"hello\" is nothing that a polygon model has");
}

TEST(Gzip, RefusesWhatIsCutShortOrDamaged)
{
    const std::string whole = compressed(triangle);
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_EQ(reading_error(folder.write("cut.obj.gz", whole.substr(0, length))),
                  "cannot be decompressed: it is cut short")
            << length;
    EXPECT_THAT(reading_error(folder.write("no.obj.gz", triangle)), HasSubstr("cannot be decompressed: not gzip"));
    std::string damaged = whole;
    damaged[damaged.size() - 6] ^= 1; // of the checksum
    EXPECT_THAT(reading_error(folder.write("bad.obj.gz", damaged)), HasSubstr("cannot be decompressed: "));
}
