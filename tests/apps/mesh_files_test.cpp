// What the tool makes of mesh files that the tests write themselves.
#if defined(VISORDER_WITH_VTK)

#include "tests/apps/run_tool.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <initializer_list>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

namespace visorder::tests {
namespace {

std::vector<std::uint64_t> sorted_numbers(const std::filesystem::path& file)
{
    std::ifstream in(file);
    std::vector<std::uint64_t> numbers{std::istream_iterator<std::uint64_t>(in), {}};
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

void expect_says(const Outcome& outcome, int code, std::initializer_list<const char*> parts)
{
    EXPECT_EQ(outcome.code, code) << outcome.output;
    for (const char* part : parts)
        EXPECT_NE(outcome.output.find(part), std::string::npos) << part << "\n" << outcome.output;
}

/// A vertex, a tetrahedron, a line and a triangle beside it, and another tetrahedron below.
constexpr const char* tetrahedra_among_others =
    "# vtk DataFile Version 3.0\namong others\nASCII\nDATASET UNSTRUCTURED_GRID\n"
    "POINTS 5 double\n0 0 0  1 0 0  0 1 0  0 0 1  0 0 -1\n"
    "CELLS 5 19\n1 0\n4 0 1 2 3\n2 0 1\n3 0 1 2\n4 0 2 1 4\nCELL_TYPES 5\n1\n10\n3\n5\n10\n";

/// A line, a unit cube, of which `top` lifts a corner, and a tetrahedron beside it.
std::string cube_among_others(double top)
{
    return "# vtk DataFile Version 3.0\namong others\nASCII\nDATASET UNSTRUCTURED_GRID\n"
           "POINTS 9 double\n0 0 0  1 0 0  1 1 0  0 1 0  0 0 1  1 0 1  1 1 " +
           std::to_string(top) +
           "  0 1 1  2 0 0\n"
           "CELLS 3 17\n2 0 1\n8 0 1 2 3 4 5 6 7\n4 1 8 2 5\nCELL_TYPES 3\n3\n12\n10\n";
}

TEST(ToolOnMeshFiles, ReadsPointsWithDataThatNoCellUses)
{
    const TemporaryFolder folder;
    const auto file =
        folder.write("unused.vtk", "# vtk DataFile Version 3.0\nunused\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                   "POINTS 6 double\n9 9 9  0 0 0  1 0 0  0 1 0  0 0 1  8 8 8\n"
                                   "CELLS 1 5\n4 1 2 3 4\nCELL_TYPES 1\n10\n"
                                   "POINT_DATA 6\nSCALARS s double 1\nLOOKUP_TABLE default\n9 1 2 3 4 8\n");
    const Outcome inspected = run("inspect " + file.string());
    EXPECT_EQ(inspected.code, 0) << inspected.output;
    for (const char* part : {"2 points that no cell uses left out", "points          4\n", "s from 1 to 4"})
        EXPECT_NE(inspected.output.find(part), std::string::npos) << part << "\n" << inspected.output;
}

TEST(ToolOnMeshFiles, CellsHaveTheFilesNumbers)
{
    const TemporaryFolder folder;
    const std::string mesh = folder.write("mesh.vtk", tetrahedra_among_others).string();
    const std::vector<std::uint64_t> kept{1, 4};
    for (const char* whole : {"", " --whole"})
        for (const char* name : {"order.txt", "order.npy"}) {
            const std::string order = (folder / name).string(), map = (folder / "map.txt").string();
            SCOPED_TRACE(order + whole);
            const Outcome sorted = run("sort " + mesh + whole + " --direction 0,0,1 -o " + order + " --map " + map);
            ASSERT_EQ(sorted.code, 0) << sorted.output;
            EXPECT_EQ(sorted_numbers(map), kept);
            if (order.ends_with(".txt")) {
                EXPECT_EQ(sorted_numbers(order), kept);
                EXPECT_EQ(content_of(order), "4\n1\n");
            }
            expect_says(run("check " + mesh + whole + " " + order + " --direction=0,0,1"), 0, {"0 of 1 relations"});
            expect_says(run("check " + mesh + whole + " " + order + " --direction=0,0,-1"), 1,
                        {"cell 4 occludes cell 1 but is painted before it"});
        }
    const std::string order = (folder / "order.txt").string();
    folder.write("order.txt", "1\n0\n");
    expect_one_line_and_code_2("check " + mesh + " " + order + " --direction=0,0,1",
                               order + ": the order lists cell 0");
    folder.write("order.txt", "4\n4\n");
    expect_one_line_and_code_2("check " + mesh + " " + order + " --direction=0,0,1", "cell 4 twice");
    folder.write("order.txt", "4\n");
    expect_one_line_and_code_2("check " + mesh + " " + order + " --direction=0,0,1", "leaves out cell 1");
}

TEST(ToolOnMeshFiles, PartsHaveAMapToTheFilesNumbers)
{
    const TemporaryFolder folder;
    const std::string mesh = folder.write("mesh.vtk", cube_among_others(1)).string();
    const std::string order = (folder / "order.txt").string(), map = (folder / "map.txt").string();
    const Outcome sorted = run("sort " + mesh + " --direction 1,0,0 -o " + order + " --map " + map);
    expect_says(sorted, 0, {"--map FILE tells of which each is part"});
    const std::vector<std::uint64_t> cells = sorted_numbers(map);
    ASSERT_GE(cells.size(), 6u);
    for (std::size_t part = 0; part < cells.size(); ++part)
        EXPECT_EQ(cells[part], part + 1 < cells.size() ? 1u : 2u);
    std::vector<std::uint64_t> parts(cells.size());
    std::iota(parts.begin(), parts.end(), 0u);
    EXPECT_EQ(sorted_numbers(order), parts);
    expect_says(run("check " + mesh + " " + order + " --direction=1,0,0"), 0, {"0 of "});
    expect_says(run("check " + mesh + " " + order + " --direction=-1,0,0"), 1,
                {"part ", " (of cell 1) occludes part "});

    expect_says(run("sort " + mesh + " --whole --direction 1,0,0 -o " + order + " --map " + map), 0, {"2 cells"});
    EXPECT_EQ(content_of(order), "1\n2\n");
    EXPECT_EQ(content_of(map), "1\n2\n");
}

TEST(ToolOnMeshFiles, FaultsNameTheFileAndItsCell)
{
    const TemporaryFolder folder;
    const std::string mesh = folder.write("warped.vtk", cube_among_others(1.5)).string();
    const std::string order = (folder / "order.txt").string();
    expect_one_line_and_code_2("sort " + mesh + " --whole --sorter mpvo --direction 1,0,0 -o " + order,
                               "warped.vtk: cell 1: face ");
    expect_one_line_and_code_2("compare " + mesh + " --whole --sorters mpvo --views 1 --frames 0",
                               "warped.vtk: cell 1: a face is not planar");
}

TEST(ToolOnMeshFiles, TrianglesOfPolygonsHaveAMapToThem)
{
    const TemporaryFolder folder;
    const std::string mesh =
        folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nl 1 2\nf 1 2 3 4\nf 1 2 4\n").string();
    const std::string order = (folder / "order.txt").string(), map = (folder / "map.txt").string();
    expect_says(run("sort " + mesh + " --sorter newell --direction 0,0,1 -o " + order + " --map " + map), 0,
                {"cells are parts of the file's cells"});
    EXPECT_EQ(content_of(map), "1\n1\n2\n");
    EXPECT_EQ(sorted_numbers(order), (std::vector<std::uint64_t>{0, 1, 2}));
}

/// One tetrahedron with these point data.
std::string tetrahedron_with(const std::string& point_data)
{
    return "# vtk DataFile Version 3.0\nwith data\nASCII\nDATASET UNSTRUCTURED_GRID\n"
           "POINTS 4 double\n500000.125 0 0  500000.25 0 0  500000.125 1 0  500000.125 0 1\n"
           "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\n" +
           point_data;
}

TEST(ToolOnMeshFiles, TellsBoundsAndRangesApart)
{
    const TemporaryFolder folder;
    const std::string mesh =
        folder
            .write("mesh.vtk", tetrahedron_with("SCALARS s double 1\nLOOKUP_TABLE default\n"
                                                "1000000000 1000000000.25 1000000000.5 1000000001\n"))
            .string();
    expect_says(run("inspect " + mesh), 0,
                {"500000.125,0,0 to 500000.25,1,1", "s from 1e+09 to 1000000001",
                 "array           s: of points, double, 1 component, from 1e+09 to 1000000001"});
}

TEST(ToolOnMeshFiles, CountsNotANumberAsMissing)
{
    const TemporaryFolder folder;
    const std::string mesh =
        folder
            .write("mesh.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
                               "$EndNodes\n$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n"
                               "$NodeData\n1\n\"s\"\n1\n0.0\n3\n0\n1\n3\n1 2\n3 3\n4 7\n$EndNodeData\n")
            .string();
    const std::string out = (folder / "out.png").string();
    expect_says(run("inspect " + mesh), 0, {"1 scalars are missing", "s from 2 to 7", "from 2 to 7, 1 missing"});
    expect_one_line_and_code_2("render " + mesh + " --direction 1,1,1 --size 8x8 -o " + out, "each of the 1 cells");
    EXPECT_EQ(run("render " + mesh + " --nan lowest --direction 1,1,1 --size 8x8 -o " + out).code, 0);
    expect_one_line_and_code_2("render " + mesh + " --nan refuse --direction 1,1,1 --size 8x8 -o " + out, "--nan");
    expect_says(run("sort " + mesh + " --direction 1,1,1 -o " + (folder / "order.txt").string()), 0, {"1 cells"});
}

TEST(ToolOnMeshFiles, SortsAroundThreeCellsAtOneFace)
{
    const TemporaryFolder folder;
    // A vertex first, so that the file's numbers are not the mesh's.
    const std::string mesh =
        folder
            .write("mesh.vtk", "# vtk DataFile Version 3.0\nthree\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                               "POINTS 6 double\n0 0 0  6 0 0  0 6 0  1 1 5  1 1 -5  2 1 -9\n"
                               "CELLS 4 17\n1 0\n4 0 1 2 3\n4 0 1 2 4\n4 0 1 2 5\nCELL_TYPES 4\n1\n10\n10\n10\n")
            .string();
    const std::string order = (folder / "order.txt").string();
    const char* said = "mesh.vtk: cell 1, cell 2 and cell 3 share one face";
    expect_says(run("inspect " + mesh), 0, {said, "crowded faces   1"});
    for (const char* sorter : {"auto", "bsp-xmpvo", "xmpvo-exact", "newell", "xmpvo", "mpvo", "mpvo-nc", "centroid"}) {
        SCOPED_TRACE(sorter);
        expect_says(run("sort " + mesh + " --direction 0,0,1 --sorter " + sorter + " -o " + order), 0, {said});
        EXPECT_EQ(sorted_numbers(order), (std::vector<std::uint64_t>{1, 2, 3}));
    }
    for (const char* sorter : {"auto", "bsp-xmpvo", "xmpvo-exact", "newell"}) {
        SCOPED_TRACE(sorter);
        ASSERT_EQ(run("sort " + mesh + " --direction 0,0,1 --sorter " + sorter + " -o " + order).code, 0);
        EXPECT_TRUE(content_of(order).ends_with("1\n")) << content_of(order);
        expect_says(run("check " + mesh + " " + order + " --direction 0,0,1"), 0, {"0 of 2 relations violated", said});
    }
}

} // namespace
} // namespace visorder::tests

#endif
