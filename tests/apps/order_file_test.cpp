#include "apps/order_file.h"

#include "tests/temporary_folder.h"
#include "visorder/error.h"

#include <fstream>
#include <gtest/gtest.h>

namespace visorder::tests {

using namespace apps;
namespace {

void write(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

std::string npy(const std::string& type, const std::string& shape, const std::string& data)
{
    std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }\n";
    return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header + data;
}

std::string message_of(const std::filesystem::path& file)
{
    try {
        read_order(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(OrderFile, ReadsWhatItWrites)
{
    const TemporaryFolder folder;
    for (const char* name : {"order.txt", "order.npy"})
        for (const std::vector<std::uint64_t>& cells :
             {std::vector<std::uint64_t>{}, {7}, {3, 0, 4294967295u, 1}, {3, 4294967296u}}) {
            write_order(folder / name, cells);
            EXPECT_EQ(read_order(folder / name), cells) << name;
        }
}

TEST(OrderFile, AlignsTheArrayAsNumPyDoes)
{
    const TemporaryFolder folder;
    write_order(folder / "order.npy", std::vector<std::uint64_t>{1, 2, 3});
    EXPECT_EQ((std::filesystem::file_size(folder / "order.npy") - 12) % 64, 0u);
}

TEST(OrderFile, ReadsIntegersOfAnyKind)
{
    const TemporaryFolder folder;
    write(folder / "a.npy", npy("<i8", "(2,)", std::string("\x05\0\0\0\0\0\0\0\x01\x02\0\0\0\0\0\0", 16)));
    EXPECT_EQ(read_order(folder / "a.npy"), (std::vector<std::uint64_t>{5, 513}));
    write(folder / "b.npy", npy(">u2", "(2,)", std::string("\0\x05\x02\x01", 4)));
    EXPECT_EQ(read_order(folder / "b.npy"), (std::vector<std::uint64_t>{5, 513}));
    write(folder / "c.npy", npy("|u1", "(2,)", "\x05\x07"));
    EXPECT_EQ(read_order(folder / "c.npy"), (std::vector<std::uint64_t>{5, 7}));
    write(folder / "d.txt", "5\r\n513\r\n");
    EXPECT_EQ(read_order(folder / "d.txt"), (std::vector<std::uint64_t>{5, 513}));
}

TEST(OrderFile, SaysWhatIsWrongWithAFile)
{
    const TemporaryFolder folder;
    EXPECT_NE(message_of(folder / "none.txt").find("cannot be opened"), std::string::npos);
    write(folder / "a.txt", "1\ntwo\n");
    EXPECT_NE(message_of(folder / "a.txt").find("line 2"), std::string::npos);
    write(folder / "b.txt", "1\n-2\n");
    EXPECT_NE(message_of(folder / "b.txt").find("line 2"), std::string::npos);
    write(folder / "c.npy", "not numpy");
    EXPECT_NE(message_of(folder / "c.npy").find("not a NumPy array"), std::string::npos);
    write(folder / "d.npy", npy("<f8", "(1,)", std::string(8, '\0')));
    EXPECT_NE(message_of(folder / "d.npy").find("integers"), std::string::npos);
    write(folder / "e.npy", npy("<u4", "(2,)", std::string(4, '\0')));
    EXPECT_NE(message_of(folder / "e.npy").find("shape"), std::string::npos);
    write(folder / "f.npy", npy("<i4", "(1,)", "\xff\xff\xff\xff"));
    EXPECT_NE(message_of(folder / "f.npy").find("entry 0"), std::string::npos);
    write(folder / "g.npy", npy("<u4", "(1, 1)", std::string(4, '\0')));
    EXPECT_NE(message_of(folder / "g.npy").find("one dimension"), std::string::npos);
}

TEST(OrderFile, TakesNoHugeCountOrHeader)
{
    const TemporaryFolder folder;
    // 2^62 numbers of 4 bytes are, modulo 2^64, none.
    for (const char* shape : {"(4611686018427387904,)", "(99999999999999999999999,)"}) {
        write(folder / "a.npy", npy("<u4", shape, ""));
        EXPECT_NE(message_of(folder / "a.npy").find("shape"), std::string::npos) << shape;
    }
    std::string long_header = std::string("\x93NUMPY\x02\x00\x00\x00\x10\x00", 12);
    long_header += "{'descr': '<u4', 'shape': (" + std::string(1 << 20, '1');
    write(folder / "b.npy", long_header);
    EXPECT_NE(message_of(folder / "b.npy").find("header"), std::string::npos);
}

} // namespace
} // namespace visorder::tests
