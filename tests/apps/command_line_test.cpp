// Options, outputs and messages of the command line.

#include "tests/apps/run_tool.h"
#include "tests/temporary_folder.h"

#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/stat.h>

namespace visorder::tests {
namespace {

namespace fs = std::filesystem;

const std::string sort_scene = "sort --scene delaunay:300 --eye 3,2,1 --sorter mpvo ";

/// 300 lines, each a number.
bool is_order(const std::string& text)
{
    return std::count(text.begin(), text.end(), '\n') > 250 &&
           text.find_first_not_of("0123456789\n") == std::string::npos;
}

TEST(CommandLine, SaysThatThereIsNoSuchCommand)
{
    expect_one_line_and_code_2("foo", "there is no command \"foo\"; there are: compare, sort");
    expect_one_line_and_code_2("--threads 2 foo mesh.vtu", "there is no command \"foo\"");
}

TEST(CommandLine, OptionsLeaveWhatFollowsToThePositionals)
{
    const TemporaryFolder folder;
    const std::string order = (folder / "order.txt").string();
    ASSERT_EQ(run("sort --scene delaunay:300 --direction 0,0,1 -o " + order).code, 0);
    for (const char* view : {"--direction 0,0,1", "--direction 0 0 1", "--direction=0,0,1"}) {
        const Outcome checked = run("check --scene delaunay:300 " + std::string(view) + " " + order);
        EXPECT_EQ(checked.code, 0) << view << "\n" << checked.output;
    }
    expect_one_line_and_code_2("compare --views 1 --sorters mpvo /nowhere/mesh.vtu", "/nowhere/mesh.vtu");
    expect_one_line_and_code_2("compare --views 1 --scene pinwheel /nowhere/mesh.vtu --sorters quicksort", "quicksort");
}

TEST(CommandLine, RefusesNumbersOutOfRange)
{
    const TemporaryFolder folder;
    const std::string render = "render --scene grid:300 --eye 3,2,1 -o " + (folder / "picture.png").string();
    for (const char* option : {"--background 2,0,0", "--background=-1,0,0", "--background nan,0,0", "--unit-length 0",
                               "--unit-length=-1", "--unit-length nan", "--view-angle 0", "--view-angle 180",
                               "--table-lengths 0", "--table-scalars=-1", "--bsp-seed=-1"})
        expect_one_line_and_code_2(render + " " + option, std::string(option).substr(0, 8));
    expect_one_line_and_code_2("compare --scene pinwheel --seed -1", "--seed");
    expect_one_line_and_code_2("check --scene pinwheel order.txt --eye 3,2,1 --witnesses -1", "--witnesses");
    EXPECT_FALSE(fs::exists(folder / "picture.png"));
}

TEST(CommandLine, NamesTheSorterThatAutoTakes)
{
    const TemporaryFolder folder;
    const std::string order = (folder / "order.txt").string(), picture = (folder / "picture.png").string();
    const Outcome sorted = run("sort --scene delaunay:300 --eye 3,2,1 -o " + order);
    EXPECT_NE(sorted.output.find("by auto: mpvo (exact)"), std::string::npos) << sorted.output;
    const Outcome drawn = run("render --scene delaunay:300 --eye 3,2,1 --size 16x16 -o " + picture);
    EXPECT_NE(drawn.output.find("sorted by auto: mpvo (exact)"), std::string::npos) << drawn.output;
}

/// Runs the tool with its standard output and error in files.
int run_into(const std::string& arguments, const std::string& output, const std::string& messages)
{
    return run(arguments + " >" + output + " 2>" + messages + " || exit 9; :").code;
}

TEST(CommandLine, WritesToStandardOutputByAnyOfItsNames)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "out").string(), messages = (folder / "messages").string();
    for (const char* name : {"-", "/dev/stdout", "/dev/fd/1"}) {
        ASSERT_EQ(run_into(sort_scene + "-o " + name, file, messages), 0) << name;
        EXPECT_TRUE(is_order(content_of(file))) << name;
        EXPECT_NE(content_of(messages).find("farthest first"), std::string::npos) << name;
        ASSERT_EQ(run_into(sort_scene + "-o " + name + " | cat", file, messages), 0) << name;
        EXPECT_TRUE(is_order(content_of(file))) << name;
    }
    ASSERT_EQ(run_into("render --scene grid:300 --eye 3,2,1 --size 16x16 -o -", file, messages), 0);
    EXPECT_TRUE(content_of(file).starts_with("\x89PNG"));
    ASSERT_EQ(run_into("compare --scene pinwheel --sorters mpvo --views 1 --frames 0 --json -", file, messages), 0);
    EXPECT_TRUE(nlohmann::json::accept(content_of(file))) << content_of(file);
    EXPECT_TRUE(fs::is_symlink("/dev/stdout"));
}

TEST(CommandLine, OutputsGoThroughLinksAndKeepModes)
{
    const TemporaryFolder folder;
    const fs::path file = folder.write("file", "before"), link = folder / "link", pending = folder / "pending";
    fs::create_symlink("file", link);
    fs::create_symlink("not-there-yet", pending);
    chmod(file.c_str(), 0640);
    ASSERT_EQ(run(sort_scene + "-o " + link.string()).code, 0);
    ASSERT_EQ(run(sort_scene + "-o " + pending.string()).code, 0);
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_TRUE(fs::is_symlink(pending));
    EXPECT_TRUE(is_order(content_of(file)));
    EXPECT_TRUE(is_order(content_of(folder / "not-there-yet")));
    EXPECT_EQ(static_cast<int>(fs::status(file).permissions()), 0640);

    const fs::path other_name = folder / "other-name";
    fs::create_hard_link(file, other_name);
    ASSERT_EQ(run("sort --scene delaunay:300 --eye=-3,2,1 --sorter mpvo -o " + file.string()).code, 0);
    EXPECT_EQ(content_of(file), content_of(other_name));
    for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_NE(entry.path().extension(), ".part");
}

TEST(CommandLine, TestsOutputsBeforeTheWork)
{
    const TemporaryFolder folder;
    const std::string inside = folder.write("file", "text").string() + "/order.txt";
    // The mesh is not there either: what is said first was looked at first.
    expect_one_line_and_code_2("sort /nowhere/mesh.vtu --eye 1,2,3 -o /nowhere/order.txt", "/nowhere/order.txt");
    expect_one_line_and_code_2("sort /nowhere/mesh.vtu --eye 1,2,3 -o " + inside, inside);
    expect_one_line_and_code_2("sort /nowhere/mesh.vtu --eye 1,2,3 -o " + folder.path().string(), "directory");
    expect_one_line_and_code_2("sort /nowhere/mesh.vtu --eye 1,2,3 -o a.txt --map /nowhere/map.txt",
                               "/nowhere/map.txt");
    expect_one_line_and_code_2("sort /nowhere/mesh.vtu --eye 1,2,3 -o a.txt --map a.txt", "a.txt");
    expect_one_line_and_code_2("render /nowhere/mesh.vtu --eye 1,2,3 -o /nowhere/a.png", "/nowhere/a.png");
    expect_one_line_and_code_2("compare /nowhere/mesh.vtu --json /nowhere/a.json", "/nowhere/a.json");
    expect_one_line_and_code_2("compare /nowhere/mesh.vtu --images " + inside, inside);
    expect_one_line_and_code_2("layers /nowhere/mesh.vtu -o " + inside, inside);
    EXPECT_FALSE(fs::exists("a.txt"));
}

TEST(CommandLine, KnowsEndingsInCapitals)
{
    const TemporaryFolder folder;
    const std::string order = (folder / "ORDER.NPY").string(), picture = (folder / "PICTURE.PNG").string();
    ASSERT_EQ(run(sort_scene + "-o " + order).code, 0);
    EXPECT_TRUE(content_of(order).starts_with("\x93NUMPY"));
    EXPECT_EQ(run("check --scene delaunay:300 " + order + " --eye 3,2,1").code, 0);
    ASSERT_EQ(run("render --scene grid:300 --eye 3,2,1 --size 16x16 -o " + picture).code, 0);
    EXPECT_TRUE(content_of(picture).starts_with("\x89PNG"));
}

TEST(CommandLine, ComparesOnTheOthersWhereOneFileIsBad)
{
    const TemporaryFolder folder;
    const std::string json = (folder / "result.json").string();
    const std::string model = folder.write("good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
    const std::string bad = folder.write("bad.obj", "v 0 0\n").string();
    fs::create_directory(folder / "other");
    const std::string same_name = folder.write("other/good.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n").string();
    const Outcome outcome =
        run("compare " + bad + " " + model + " " + same_name + " --sorters newell --views 1 --images " +
            (folder / "images").string() + " --json " + json);
    EXPECT_EQ(outcome.code, 2) << outcome.output;
    for (const std::string& part : {bad + ": line 1", model + ": 1 cells", same_name + ": 1 cells",
                                    std::string("not compared, for what standard error says: bad.obj")})
        EXPECT_NE(outcome.output.find(part), std::string::npos) << part << "\n" << outcome.output;
    const auto result = nlohmann::json::parse(content_of(json));
    ASSERT_EQ(result["scenes"].size(), 2u);
    EXPECT_NE(result["scenes"][0]["name"], result["scenes"][1]["name"]);
    ASSERT_EQ(result["refused"].size(), 1u);
    EXPECT_EQ(result["refused"][0]["source"], "bad.obj");
}

TEST(CommandLine, WitnessesLimitEveryList)
{
    const TemporaryFolder folder;
    const std::string order = (folder / "order.txt").string();
    ASSERT_EQ(run("sort --scene cards:200 --eye 3,2,1 --sorter centroid -o " + order).code, 0);
    const auto lines = [&](const char* most) {
        const Outcome checked =
            run("check --scene cards:200 " + order + " --eye 3,2,1 --witnesses " + std::string(most));
        EXPECT_NE(checked.output.find("pairs of cells overlap in space"), std::string::npos) << checked.output;
        return std::count(checked.output.begin(), checked.output.end(), '\n');
    };
    const auto none = lines("0"), two = lines("2");
    EXPECT_LE(none, 8);
    EXPECT_GT(two, none);
    EXPECT_LE(two, none + 6);
}

} // namespace
} // namespace visorder::tests
