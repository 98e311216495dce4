#include "tests/apps/run_tool.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace visorder::tests {
namespace {

std::string read(const std::filesystem::path& file)
{
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

TEST(Tool, SortsAndChecksWhatItSorted)
{
    const TemporaryFolder folder;
    for (const char* name : {"order.txt", "order.npy"})
        for (const char* view : {"--eye 3,2,1", "--direction 0,0,1"}) {
            const std::string file = (folder / name).string();
            const Outcome sorted = run("sort --scene delaunay:2000 --sorter mpvo " + std::string(view) + " -o " + file);
            ASSERT_EQ(sorted.code, 0) << sorted.output;
            const Outcome checked = run("check --scene delaunay:2000 " + file + " " + view);
            EXPECT_EQ(checked.code, 0) << checked.output;
            EXPECT_TRUE(checked.output.starts_with("0 of ")) << checked.output;
        }
    // Seen from the other side, the same order is wrong, and the check shows where.
    const std::string order = (folder / "order.npy").string();
    const Outcome wrong = run("check --scene delaunay:2000 " + order + " --direction 0,0,-1 --witnesses 3");
    EXPECT_EQ(wrong.code, 1) << wrong.output;
    EXPECT_NE(wrong.output.find("is painted before it"), std::string::npos) << wrong.output;
}

TEST(Tool, ChecksByRaysAndByAllPairs)
{
    const TemporaryFolder folder;
    const std::string order = (folder / "order.npy").string();
    ASSERT_EQ(run("sort --scene delaunay:3000 --sorter mpvo --direction 0,0,1 -o " + order).code, 0);
    const Outcome right = run("check --scene delaunay:3000 " + order + " --direction 0,0,1 --rays 300 --pairs");
    EXPECT_EQ(right.code, 0) << right.output;
    EXPECT_NE(right.output.find("\nall pairs: 0 of "), std::string::npos) << right.output;
    EXPECT_NE(right.output.find("\n300 rays: "), std::string::npos) << right.output;
    EXPECT_NE(right.output.find(", 0 pairs in the wrong order"), std::string::npos) << right.output;
    const Outcome wrong = run("check --scene delaunay:3000 " + order + " --direction 0,0,-1 --rays 300 --witnesses 1");
    EXPECT_EQ(wrong.code, 1) << wrong.output;
    EXPECT_EQ(wrong.output.find("all pairs"), std::string::npos) << wrong.output;
    EXPECT_EQ(wrong.output.find(" 0 pairs in the wrong order"), std::string::npos) << wrong.output;
    // Unasked, where there are few cells.
    ASSERT_EQ(run("sort --scene carved:900 --direction 0,0,1 -o " + order).code, 0);
    const Outcome small = run("check --scene carved:900 " + order + " --direction 0,0,1");
    EXPECT_EQ(small.code, 0) << small.output;
    EXPECT_NE(small.output.find("\nall pairs: 0 of "), std::string::npos) << small.output;
}

TEST(Tool, ComparesAgainstRays)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "result.json").string();
    const Outcome outcome =
        run("compare --scene carved:900 --sorters centroid,bsp-xmpvo --views 2 --frames 0 --audit 400 "
            "--json " +
            file);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto result = nlohmann::json::parse(read(file));
    ASSERT_EQ(result["runs"].size(), 4u);
    std::size_t wrong_centroid = 0;
    for (const auto& run : result["runs"]) {
        EXPECT_EQ(run["audit_rays"], 400);
        EXPECT_GT(run["audit_pairs"], 400);
        if (run["sorter"] == "centroid")
            wrong_centroid += run["audit_violations"].get<std::size_t>();
        else
            EXPECT_EQ(run["audit_violations"], 0);
    }
    EXPECT_GT(wrong_centroid, 0u);
}

TEST(Tool, ComparesAndWritesTheResultFormat)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "result.json").string();
    const Outcome outcome =
        run("compare --scene delaunay:1500,carved:1500,pinwheel --views 2 --hard --size 64x64 --json " + file);
    ASSERT_EQ(outcome.code, 0) << outcome.output;
    const auto result = nlohmann::json::parse(read(file));
    for (const char* key : {"visorder", "machine", "scenes", "runs"})
        ASSERT_TRUE(result.contains(key)) << key;
    for (const char* key : {"cpu", "threads", "gl_renderer"})
        EXPECT_TRUE(result["machine"].contains(key)) << key;
    ASSERT_EQ(result["scenes"].size(), 3u);
    EXPECT_TRUE(result["scenes"][0]["convex"]);
    EXPECT_FALSE(result["scenes"][1]["convex"]);
    std::size_t wrong_centroid = 0, wrong_mpvo_convex = 0, wrong_mpvo_carved = 0, pinwheel_cycles = 0;
    for (const auto& run : result["runs"]) {
        if (run["sorter"].get<std::string>().starts_with("layers")) {
            EXPECT_NE(run["skipped"].get<std::string>().find("xmpvo-layered"), std::string::npos);
            continue;
        }
        for (const char* key : {"scene", "view", "sorter", "guarantee", "prepare_s", "sort_s", "structure_bytes",
                                "relations", "violations", "cycles", "cells_in_cycles", "image_rmse", "image_max"})
            ASSERT_TRUE(run.contains(key)) << key;
        EXPECT_GT(run["sort_s"], 0);
        EXPECT_GT(run["relations"], 0);
        const std::size_t violations = run["violations"];
        if (run["sorter"] == "centroid")
            wrong_centroid += violations;
        if (run["sorter"] == "mpvo") {
            (run["scene"] == "delaunay:1500" ? wrong_mpvo_convex : wrong_mpvo_carved) += violations;
            if (run["scene"] == "pinwheel")
                pinwheel_cycles += run["cycles"].get<std::size_t>();
        }
    }
    EXPECT_GT(wrong_centroid, 0u);
    EXPECT_EQ(wrong_mpvo_convex, 0u);
    EXPECT_GT(wrong_mpvo_carved, 0u);
    EXPECT_GT(pinwheel_cycles, 0u);
    EXPECT_EQ(outcome.output.find('\033'), std::string::npos) << "no colours and no progress outside of a terminal";
}

TEST(Tool, InspectsAndLists)
{
    const Outcome inspected = run("inspect --scene fin:3000");
    EXPECT_EQ(inspected.code, 0);
    for (const char* part : {"tetrahedron", "convex          no", "auto            bsp-xmpvo"})
        EXPECT_NE(inspected.output.find(part), std::string::npos) << part << "\n" << inspected.output;
    const Outcome whole = run("inspect --scene grid:600 --whole");
    EXPECT_NE(whole.output.find("hexahedron"), std::string::npos) << whole.output;
    const Outcome listed = run("sorters");
    EXPECT_EQ(listed.code, 0);
    EXPECT_NE(listed.output.find("Williams 1992"), std::string::npos) << listed.output;
}

TEST(Tool, Renders)
{
    const TemporaryFolder folder;
    for (const char* file : {"picture.png", "picture.exr"}) {
        const std::string out = (folder / file).string();
        const Outcome outcome = run("render --scene grid:500 --eye 3,2,1 --size 40x30 -o " + out);
        ASSERT_EQ(outcome.code, 0) << outcome.output;
        EXPECT_NE(outcome.output.find("40 x 30"), std::string::npos) << outcome.output;
        EXPECT_TRUE(std::filesystem::exists(out));
    }
    const std::string out = (folder / "other.png").string();
    const Outcome outcome = run("render --scene grid:500 --camera 3,2,1,0,0,0,0,1,0 --size 16x16 --projector planes "
                                "--integrator exponential --transfer steps --blending 16 --gl osmesa -o " +
                                out);
    EXPECT_EQ(outcome.code, 0) << outcome.output;
}

TEST(Tool, NeedsNoView)
{
    const TemporaryFolder folder;
    const std::string out = (folder / "picture.png").string(), order = (folder / "order.txt").string();
    EXPECT_EQ(run("sort --scene delaunay:300 -o " + order).code, 0);
    EXPECT_EQ(run("check --scene delaunay:300 " + order).code, 0) << "both look from the same place";
    const Outcome drawn = run("render --scene delaunay:300 -o " + out);
    EXPECT_EQ(drawn.code, 0) << drawn.output;
    EXPECT_EQ(drawn.output.find("0 of"), std::string::npos) << drawn.output;

    const std::string without_scalars =
        folder
            .write("mesh.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
                               "$EndNodes\n$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n")
            .string();
    const Outcome alike = run("render " + without_scalars + " -o " + out);
    EXPECT_EQ(alike.code, 0) << alike.output;
    EXPECT_NE(alike.output.find("the mesh has no scalars"), std::string::npos) << alike.output;
    EXPECT_EQ(alike.output.find("0 of"), std::string::npos) << alike.output;
}

TEST(Tool, SaysWhyAPictureIsBlank)
{
    const TemporaryFolder folder;
    const std::string out = (folder / "picture.png").string();
    const std::string nothing = (folder / "nothing.json").string();
    std::ofstream(nothing) << R"({"points": [{"scalar": 0, "extinction": 0, "colour": [1, 1, 1]}]})";
    const Outcome transparent = run("render --scene delaunay:300 --transfer " + nothing + " -o " + out);
    EXPECT_EQ(transparent.code, 0) << transparent.output;
    EXPECT_NE(transparent.output.find("cells are visible: the transfer function is transparent"), std::string::npos)
        << transparent.output;
    const Outcome elsewhere = run("render --scene delaunay:300 --camera 9,9,9,20,20,20,0,1,0 -o " + out);
    EXPECT_EQ(elsewhere.code, 0) << elsewhere.output;
    EXPECT_NE(elsewhere.output.find("cells are visible: the view shows nothing"), std::string::npos)
        << elsewhere.output;
}

TEST(Tool, RefusesToRenderWhatItCannot)
{
    const TemporaryFolder folder;
    const std::string out = (folder / "picture.png").string();
    const std::string render = "render --scene grid:500 --eye 3,2,1 -o " + out;
    expect_one_line_and_code_2(render + " --size 0x5", "--size");
    expect_one_line_and_code_2(render + " --size 1000000x5", "1000000");
    expect_one_line_and_code_2(render + " --transfer nowhere.json", "nowhere.json");
    expect_one_line_and_code_2(render + " --projector guess", "guess");
    expect_one_line_and_code_2(render + " --integrator guess", "guess");
    expect_one_line_and_code_2(render + " --blending 12", "12");
    expect_one_line_and_code_2(render + " --whole", "subdivide");
    expect_one_line_and_code_2(render + " --gl guess", "guess");
    expect_one_line_and_code_2("render --scene grid:500 --eye 3,2,1 -o " + out + ".gif", ".gif");
    const std::string function = (folder / "function.json").string();
    const auto refused = [&](const std::string& points, const std::string& words) {
        std::ofstream(function) << "{\"points\": [" + points + "]}";
        expect_one_line_and_code_2(render + " --transfer " + function, words);
    };
    refused(
        R"({"scalar": 1, "extinction": 1, "colour": [1, 1, 1]}, {"scalar": 0, "extinction": 1, "colour": [1, 1, 1]})",
        "below");
    refused(R"({"scalar": 1, "extinction": -1, "colour": [1, 1, 1]})", "-1");
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Tool, TakesSurfaceScenes)
{
    const TemporaryFolder folder;
    const std::string order = (folder / "order.txt").string();
    const Outcome compared =
        run("compare --scene shells:500,cards:200,sphere:100,knot:300 --views 2 --hard --layer-size 64x64");
    EXPECT_EQ(compared.code, 0) << compared.output;
    for (const char* part : {"0 boundary edges, surface\n", "pairs of cells overlap", "power            skipped"})
        EXPECT_NE(compared.output.find(part), std::string::npos) << part << "\n" << compared.output;
    const Outcome sorted = run("sort --scene cards:200 --eye 3,2,1 --sorter centroid -o " + order);
    EXPECT_EQ(sorted.code, 0) << sorted.output;
    const Outcome checked = run("check --scene cards:200 " + order + " --eye 3,2,1");
    EXPECT_EQ(checked.code, 1) << checked.output;
    for (const char* part : {"is painted before it", "overlap in space"})
        EXPECT_NE(checked.output.find(part), std::string::npos) << part << "\n" << checked.output;
    const Outcome inspected = run("inspect --scene cards:200");
    EXPECT_EQ(inspected.code, 0) << inspected.output;
    EXPECT_NE(inspected.output.find("400 edges in 100 components"), std::string::npos) << inspected.output;
}

TEST(Tool, ExtractsLayersAndPaintsThem)
{
    const TemporaryFolder folder;
    for (const char* model : {"--scene shells:300", "--scene reactor:600"}) {
        SCOPED_TRACE(model);
        const std::string pictures = (folder / "pictures").string();
        const Outcome layers =
            run("layers " + std::string(model) + " --frames 2 --size 90x70,64x64 --block 32 --check -o " + pictures);
        EXPECT_EQ(layers.code, 0) << layers.output;
        for (const char* part : {"vertices", "triangles", "90x70", "64x64", "layers-blocked", "layers-compute",
                                 "render %", "read %", "scan %", " 0 wrong, 0 missed"})
            EXPECT_NE(layers.output.find(part), std::string::npos) << part << "\n" << layers.output;
        for (const char* file : {"layers.png", "turned.png", "layer-001.png"})
            EXPECT_TRUE(std::filesystem::exists(folder / "pictures" / file)) << file;
        std::filesystem::remove_all(folder / "pictures");
    }
}

// Mesa can be told to have an older OpenGL.
TEST(Tool, SaysInOneLineThatThereIsNoOpenGl)
{
    const TemporaryFolder folder;
    const std::string out = (folder / "order.txt").string();
    setenv("MESA_GL_VERSION_OVERRIDE", "3.3", 1);
    expect_one_line_and_code_2("sort --scene sphere:100 --eye 3,2,1 --sorter layers -o " + out, "OpenGL 4.5");
    expect_one_line_and_code_2("sort --scene delaunay:500 --eye 3,2,1 --sorter xmpvo-layered --gl osmesa -o " + out,
                               "OpenGL 4.5");
    const Outcome compared = run("compare --scene carved:500 --views 1 --sorters mpvo,xmpvo-layered");
    unsetenv("MESA_GL_VERSION_OVERRIDE");
    EXPECT_EQ(compared.code, 0) << compared.output;
    EXPECT_NE(compared.output.find("xmpvo-layered    skipped: "), std::string::npos) << compared.output;
}

TEST(Tool, InspectsHexahedraWithFacesThatAreNotPlanar)
{
    const Outcome inspected = run("inspect --scene gear-helical:2000 --whole");
    EXPECT_EQ(inspected.code, 0) << inspected.output;
    EXPECT_NE(inspected.output.find("planar faces    no"), std::string::npos) << inspected.output;
}

TEST(Tool, AnswersBadInputWithOneLineAndCode2)
{
    const TemporaryFolder folder;
    const std::string out = (folder / "order.txt").string();
    expect_one_line_and_code_2("", "subcommand");
    expect_one_line_and_code_2("compare --scene nowhere", "nowhere");
    expect_one_line_and_code_2("compare --scene delaunay:0", "delaunay:0");
    expect_one_line_and_code_2("compare --sorters quicksort --scene delaunay:500", "quicksort");
    expect_one_line_and_code_2("compare --size 512 --scene delaunay:500", "--size");
    expect_one_line_and_code_2("compare --views 0", "--views");
    expect_one_line_and_code_2("compare --threads 0", "--threads");
    expect_one_line_and_code_2("compare --scene delaunay:500 --json /nowhere/result.json", "/nowhere/result.json");
    expect_one_line_and_code_2("sort --eye 1,2,3 -o " + out, "no mesh");
    expect_one_line_and_code_2("sort --scene sphere:20 --sorter layers --layer-size 64 --eye 1,2,3 -o " + out,
                               "--layer-size");
    expect_one_line_and_code_2("sort --scene sphere:20 --sorter layers --layer-block 48 --eye 1,2,3 -o " + out, "48");
    expect_one_line_and_code_2("sort --scene sphere:20 --sorter layers --gl glx --eye 1,2,3 -o " + out, "glx");
    expect_one_line_and_code_2("sort --scene delaunay:500 --sorter layers --eye 1,2,3 -o " + out, "xmpvo-layered");
    expect_one_line_and_code_2("layers --scene sphere:20 --size 1x2x3 -o " + (folder / "pictures").string(), "--size");
    expect_one_line_and_code_2("sort --scene delaunay:500 --eye 1,2 -o " + out, "--eye");
    expect_one_line_and_code_2("sort --scene delaunay:500 --eye nan,0,0 -o " + out, "eye");
    expect_one_line_and_code_2("sort --scene delaunay:500 --direction 0,0,0 -o " + out, "eye");
    expect_one_line_and_code_2("sort --scene delaunay:500 --eye 1,2,3 --direction 1,0,0 -o " + out, "exclude");
    expect_one_line_and_code_2("check --scene delaunay:500 /nowhere/order.txt --eye 1,2,3", "/nowhere/order.txt");
    std::ofstream(out) << "0\n1\n1\n";
    expect_one_line_and_code_2("check --scene delaunay:500 " + out + " --eye 1,2,3", "cell 1 twice");
    expect_one_line_and_code_2("inspect /nowhere/mesh.vtu", "/nowhere/mesh.vtu");
    std::filesystem::remove(out);
    expect_one_line_and_code_2("sort --scene delaunay:500 --sorter quicksort --eye 1,2,3 -o " + out, "quicksort");
    EXPECT_FALSE(std::filesystem::exists(out)) << "nothing half-done";
}

#if defined(VISORDER_WITH_VTK)
TEST(Tool, OrdersARealMeshWithTheMapBackToItsCells)
{
    const std::filesystem::path fin = std::filesystem::path(VISORDER_DATA_DIR) / "volumes/bluntfinxyz.bin";
    if (!std::filesystem::exists(fin))
        GTEST_SKIP() << "needs " << fin;
    const TemporaryFolder folder;
    const std::string order = (folder / "order.npy").string(), map = (folder / "map.txt").string();
    const Outcome sorted = run("sort " + fin.string() + " --eye 20,5,9 -o " + order + " --map " + map);
    ASSERT_EQ(sorted.code, 0) << sorted.output;
    const std::string text = read(map);
    EXPECT_GE(std::count(text.begin(), text.end(), '\n'), 37479 * 5);
    EXPECT_NE(run("check " + fin.string() + " " + order + " --eye 20,5,9").code, 2);
}
#endif

} // namespace
} // namespace visorder::tests
