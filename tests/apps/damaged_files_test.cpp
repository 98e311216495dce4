// What the tool says of files that cannot be read.

#include "tests/apps/run_tool.h"
#include "tests/temporary_folder.h"

#include <sstream>
#include <sys/stat.h>

namespace visorder::tests {
namespace {

/// How many lines say what is wrong; what `inspect` printed before does not count.
std::size_t messages(const std::string& output)
{
    std::size_t count = 0;
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);)
        count += line.starts_with("visorder: ") ? 1 : 0;
    return count;
}

TEST(ToolOnDamagedFiles, SaysInOneLineWhatIsWrongWithEachCase)
{
    const auto cases = std::filesystem::path(VISORDER_DATA_DIR) / "cases";
    if (!std::filesystem::exists(cases))
        GTEST_SKIP() << "needs " << cases;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cases)) {
        if (!entry.is_regular_file())
            continue;
        const Outcome outcome = run("inspect '" + entry.path().string() + "'");
        EXPECT_TRUE(outcome.code == 0 || outcome.code == 2) << entry.path() << ": " << outcome.code;
        if (outcome.code == 2) {
            EXPECT_EQ(messages(outcome.output), 1u) << outcome.output;
            EXPECT_EQ(outcome.output.find("crashed"), std::string::npos) << outcome.output;
        }
    }
}

TEST(ToolOnDamagedFiles, WaitsForNoPipeOrDeviceAndReadsNoFolder)
{
    const TemporaryFolder folder;
    for (const char* name : {"mesh.vtk", "mesh.vtu", "mesh.e", "mesh.obj", "meshxyz.bin", "map.json", "order.txt"})
        ASSERT_EQ(mkfifo(folder.file(name).c_str(), 0600), 0);
    for (const char* name : {"zero.vtk", "zero.vtu", "zero.e", "zero.obj", "zeroxyz.bin", "zero.json", "zero.txt"})
        std::filesystem::create_symlink("/dev/zero", folder.file(name));
    for (const char* name : {"mesh.vtk", "mesh.vtu", "mesh.e", "mesh.obj", "meshxyz.bin", "zero.vtk", "zero.vtu",
                             "zero.e", "zero.obj", "zeroxyz.bin"})
        expect_one_line_and_code_2("inspect " + folder.file(name).string(), name);
    const std::string mesh = "--scene delaunay:100";
    for (const char* name : {"map.json", "zero.json"})
        expect_one_line_and_code_2("render " + mesh + " --transfer " + folder.file(name).string() + " -o " +
                                       folder.file("image.png").string() + " --eye 3,2,1",
                                   name);
    for (const char* name : {"order.txt", "zero.txt"})
        expect_one_line_and_code_2("check " + mesh + " " + folder.file(name).string() + " --eye 3,2,1", "");
    for (const char* name : {"folder.vtk", "folder.vtu", "folder.obj", "folder.txt"}) {
        std::filesystem::create_directory(folder.file(name));
        expect_one_line_and_code_2("inspect " + folder.file(name).string(), "folder");
    }
    expect_one_line_and_code_2("check " + mesh + " " + folder.file("folder.txt").string() + " --eye 3,2,1", "folder");
}

TEST(ToolOnDamagedFiles, TakesJsonNestedDeep)
{
    const TemporaryFolder folder;
    const std::string deep(100'000, '[');
    for (const std::string& content : {deep, R"({"points": [{"scalar": 0, "extinction": 1, "colour": [)" + deep +
                                                 std::string(deep.size(), ']') + ", 0, 0]}]}"})
        expect_one_line_and_code_2("render --scene delaunay:100 --eye 3,2,1 -o " + folder.file("image.png").string() +
                                       " --transfer " + folder.write("deep.json", content).string(),
                                   "nested");
}

} // namespace
} // namespace visorder::tests
