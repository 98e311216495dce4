#include "files/cell_numbers.h"

#include <gtest/gtest.h>

namespace visorder::tests {

using namespace detail;
namespace {

std::string fault(const CellNumbers& cells, const std::vector<std::uint64_t>& numbers)
{
    try {
        cells.cells(numbers);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(CellNumbers, WholeCellsHaveTheFilesNumbers)
{
    const CellNumbers cells({6, 7, 9}, {});
    EXPECT_TRUE(cells.whole());
    EXPECT_EQ(cells.numbers(std::vector<CellId>{2, 0, 1}), (std::vector<std::uint64_t>{9, 6, 7}));
    EXPECT_EQ(cells.cells(std::vector<std::uint64_t>{9, 6, 7}), (std::vector<CellId>{2, 0, 1}));
    EXPECT_EQ(cells.name(2), "cell 9");
    EXPECT_EQ(cells.message(CellError(1, "a face is not planar")), "cell 7: a face is not planar");
    EXPECT_STREQ(CellError(1, "a face is not planar").what(), "cell 1: a face is not planar");
}

TEST(CellNumbers, PartsHaveTheirOwnAndAMapToTheFiles)
{
    const CellNumbers cells({6, 6, 9}, {});
    EXPECT_FALSE(cells.whole());
    EXPECT_EQ(cells.numbers(std::vector<CellId>{2, 0, 1}), (std::vector<std::uint64_t>{2, 0, 1}));
    EXPECT_EQ(cells.cells(std::vector<std::uint64_t>{2, 0, 1}), (std::vector<CellId>{2, 0, 1}));
    EXPECT_EQ(std::vector(cells.file_cells().begin(), cells.file_cells().end()), (std::vector<std::uint64_t>{6, 6, 9}));
    EXPECT_EQ(cells.name(1), "part 1 (of cell 6)");
}

TEST(CellNumbers, NamesTheBlock)
{
    const std::vector<MeshBlock> blocks{{"steel", 0}, {"none of it", 5}, {"fuel", 5}, {"void", 9}};
    EXPECT_EQ(CellNumbers({4, 8}, blocks).name(1), "cell 8 (block 'fuel', its cell 3)");
    EXPECT_EQ(CellNumbers({4, 8}, blocks).name(0), "cell 4 (block 'steel', its cell 4)");
    EXPECT_EQ(CellNumbers({4, 8, 8}, blocks).name(2), "part 2 (of cell 8, block 'fuel', its cell 3)");
}

TEST(CellNumbers, RefusesOrdersOfOtherCells)
{
    const CellNumbers cells({6, 7, 9}, {});
    EXPECT_EQ(fault(cells, {6, 7, 8}),
              "the order lists cell 8, which is none of the 3 cells taken of the file, 6 to 9");
    EXPECT_EQ(fault(cells, {6, 7, 10}),
              "the order lists cell 10, which is none of the 3 cells taken of the file, 6 to 9");
    EXPECT_EQ(fault(cells, {6, 7, 6}), "the order lists cell 6 twice");
    EXPECT_EQ(fault(cells, {6, 9}), "the order leaves out cell 7");
    EXPECT_EQ(fault(CellNumbers({0, 1}, {}), {0, 2}), "the order lists cell 2, but there are 2 cells");
    EXPECT_EQ(fault(CellNumbers({6, 6}, {}), {0, 2}), "the order lists cell 2, but there are 2 cells");
}

} // namespace
} // namespace visorder::tests
