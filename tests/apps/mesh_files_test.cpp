// What the tool makes of mesh files that the tests write themselves.
#if defined(VISORDER_WITH_VTK)

#include "tests/apps/run_tool.h"
#include "tests/temporary_folder.h"

#include <gtest/gtest.h>
#include <string>

namespace visorder::tests {
namespace {

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

} // namespace
} // namespace visorder::tests

#endif
