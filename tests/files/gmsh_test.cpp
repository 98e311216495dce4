#include "tests/files/byte_writer.h"
#include "tests/reading_error.h"
#include "tests/temporary_folder.h"
#include "visorder/scene.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

using namespace visorder;
using namespace visorder::tests;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

namespace {

const TemporaryFolder folder;

MeshFile read(const std::string& text, const ReadOptions& options = {})
{
    return read_mesh(folder.write("mesh.msh", text), options);
}

std::string error_of(const std::string& text, const ReadOptions& options = {})
{
    return reading_error(folder.write("mesh.msh", text), options);
}

/// A hexahedron and a prism on its side x = 1, with a triangle and a point of the boundary. Nodes have the numbers 10,
/// 20..., elements 5, 15...
constexpr std::array<std::array<double, 3>, 10> nodes{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {2, 0, 0}, {2, 0, 1}}};
struct Element {
    int type;
    std::vector<int> nodes; // from 1
};
const std::vector<Element> elements{{15, {1}}, {2, {1, 3, 2}}, {5, {1, 2, 3, 4, 5, 6, 7, 8}}, {6, {2, 9, 3, 6, 10, 7}}};

/// How a file is written.
struct Writing {
    double version;
    bool binary;
    std::endian order = std::endian::little;
};

/// Numbers of a file in text or in binary.
class Numbers {
public:
    explicit Numbers(const Writing& writing) : writing_(writing), bytes_(writing.order) {}

    Numbers& line(const std::string& text)
    {
        bytes_.text(text + "\n");
        return *this;
    }
    Numbers& integer(std::int64_t value)
    {
        writing_.binary ? bytes_.put(static_cast<std::int32_t>(value)) : bytes_.text(fmt::format("{} ", value));
        return *this;
    }
    Numbers& size(std::int64_t value)
    {
        writing_.binary ? bytes_.put(static_cast<std::uint64_t>(value)) : bytes_.text(fmt::format("{} ", value));
        return *this;
    }
    Numbers& real(double value)
    {
        writing_.binary ? bytes_.put(value) : bytes_.text(fmt::format("{} ", value));
        return *this;
    }
    Numbers& end_line()
    {
        bytes_.text("\n");
        return *this;
    }
    const std::string& file() const { return bytes_.bytes(); }

private:
    Writing writing_;
    ByteWriter bytes_;
};

void write_version_2(Numbers& out, bool binary)
{
    out.line("$Nodes").line("10");
    for (int i = 0; i < 10; ++i) {
        out.integer(10 * (i + 1));
        for (const double x : nodes[static_cast<std::size_t>(i)])
            out.real(x);
        if (!binary)
            out.end_line();
    }
    out.line("$EndNodes").line("$Elements").line("4");
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const int tag = 5 + 10 * static_cast<int>(i);
        if (binary)
            out.integer(elements[i].type).integer(1).integer(2).integer(tag);
        else
            out.integer(tag).integer(elements[i].type).integer(2);
        out.integer(1).integer(1);
        for (const int node : elements[i].nodes)
            out.integer(10 * node);
        if (!binary)
            out.end_line();
    }
    out.line("$EndElements");
}

void write_version_4(Numbers& out, bool wide)
{
    const auto number = [&](std::int64_t value) { wide ? out.size(value) : out.integer(value); };
    out.line("$Entities").line("1 2 3 whatever stands here").line("$EndEntities");
    out.line("$Nodes").size(2).size(10);
    if (wide)
        out.size(10).size(100);
    for (int block = 0; block < 2; ++block) {
        const bool parametric = block == 0;
        out.integer(wide ? 2 : 1).integer(wide ? 1 : 2).integer(parametric).size(5); // dimension 2, entity 1
        for (int i = 5 * block; wide && i < 5 * block + 5; ++i)
            out.size(10 * (i + 1));
        for (int i = 5 * block; i < 5 * block + 5; ++i) {
            if (!wide)
                out.integer(10 * (i + 1));
            for (const double x : nodes[static_cast<std::size_t>(i)])
                out.real(x);
            if (parametric)
                out.real(0.25).real(0.75);
        }
    }
    out.end_line().line("$EndNodes").line("$Elements").size(4).size(4);
    if (wide)
        out.size(5).size(35);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        out.integer(3).integer(1).integer(elements[i].type).size(1);
        number(5 + 10 * static_cast<int>(i));
        for (const int node : elements[i].nodes)
            number(10 * node);
    }
    out.end_line().line("$EndElements");
}

void write_view(Numbers& out, bool binary, const std::string& kind, const std::string& name, double time,
                const std::vector<std::pair<int, double>>& values)
{
    out.line("$" + kind).line("1").line('"' + name + '"').line("1").line(fmt::format("{}", time));
    out.line("3").line("0").line("1").line(std::to_string(values.size()));
    for (const auto& [tag, value] : values) {
        out.integer(tag).real(value);
        if (!binary)
            out.end_line();
    }
    out.line("$End" + kind);
}

std::string file(const Writing& writing)
{
    Numbers out(writing);
    out.line("$MeshFormat").line(fmt::format("{} {} 8", writing.version, writing.binary ? 1 : 0));
    if (writing.binary)
        out.integer(1).end_line();
    out.line("$EndMeshFormat").line("$PhysicalNames").line("1").line("3 1 \"all\"").line("$EndPhysicalNames");
    if (writing.version < 3)
        write_version_2(out, writing.binary);
    else
        write_version_4(out, writing.version > 4.05);
    for (const double time : {0.0, 0.5}) {
        std::vector<std::pair<int, double>> values;
        for (int i = 0; i < 9; ++i) // the last node has none
            values.emplace_back(10 * (i + 1), i + 100 * time);
        write_view(out, writing.binary, "NodeData", "heat", time, values);
    }
    write_view(out, writing.binary, "ElementData", "load", 0.5, {{25, 2}, {35, 4}});
    return out.file();
}

const std::array writings{Writing{2.2, false},
                          Writing{4, false},
                          Writing{4.1, false},
                          Writing{2.2, true},
                          Writing{4, true},
                          Writing{4.1, true},
                          Writing{2.2, true, std::endian::big},
                          Writing{4, true, std::endian::big},
                          Writing{4.1, true, std::endian::big}};

} // namespace

TEST(Gmsh, ReadsEveryVersionInTextAndBinary)
{
    for (const Writing& writing : writings) {
        SCOPED_TRACE(fmt::format("{} {} {}", writing.version, writing.binary, writing.order == std::endian::big));
        const MeshFile read_file = read(file(writing));
        EXPECT_THAT(read_file.mesh.shapes, ElementsAre(CellShape::hexahedron, CellShape::wedge));
        EXPECT_THAT(read_file.mesh.cell(0), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
        EXPECT_THAT(read_file.mesh.cell(1), ElementsAre(1, 2, 8, 5, 6, 9));
        EXPECT_THAT(read_file.file_cells, ElementsAre(2, 3));
        EXPECT_EQ(read_file.mesh.points[9], glm::dvec3(2, 0, 1));
        EXPECT_EQ(read_file.scalar, "heat");
        EXPECT_EQ(read_file.mesh.scalars[8], 58);
        EXPECT_TRUE(std::isnan(read_file.mesh.scalars[9]));
        EXPECT_THAT(read_file.notes, Contains("time step 1 (from 0) of 2, at time 0.5"));
        EXPECT_THAT(read_file.notes, Contains("1 surface cells beside the solids left out"));
        const Scene scene(read_file.mesh);
        EXPECT_EQ(scene.traits().inverted_cells, 0u);
        EXPECT_TRUE(scene.traits().face_to_face);
    }
}

TEST(Gmsh, ReadsTheViewAndTimeAskedFor)
{
    for (const Writing& writing : writings) {
        EXPECT_EQ(read(file(writing), {.time = "first"}).mesh.scalars[8], 8);
        const MeshFile loads = read(file(writing), {.scalar = "load"});
        EXPECT_EQ(loads.mesh.scalars[0], 2);
        EXPECT_EQ(loads.mesh.scalars[1], 3);
        EXPECT_EQ(loads.mesh.scalars[8], 4);
    }
    EXPECT_EQ(error_of(file(writings[0]), {.time = "7"}), "no time \"7\"; its 2 time steps are at 0, 0.5");
    EXPECT_EQ(error_of(file(writings[0]), {.scalar = "cold"}), "no scalar \"cold\"; it has: heat, load (of cells)");
}

TEST(Gmsh, ReadsVersion1)
{
    const MeshFile read_file = read("$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n7 0 0 1\n$ENDNOD\n$ELM\n2\n1 2 1 1 3 1 2 3\n"
                                    "2 4 1 1 4 1 2 3 7\n$ENDELM\n");
    EXPECT_THAT(read_file.mesh.vertices, ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(read_file.file_cells, ElementsAre(1));
}

TEST(Gmsh, TakesTheCornersOfElementsOfHigherOrder)
{
    const MeshFile read_file = read(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 0\n6 .5 .5 0\n"
        "7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n$EndNodes\n$Elements\n1\n1 11 2 0 0 1 2 3 4 5 6 7 8 9 10\n"
        "$EndElements\n");
    EXPECT_THAT(read_file.mesh.vertices, ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(read_file.notes, Contains("1 cells of higher order taken by their corners"));
}

TEST(Gmsh, RefusesFilesCutShort)
{
    for (const Writing& writing : writings) {
        const std::string whole = file(writing);
        for (std::size_t length = 0; length + 12 < whole.find("$NodeData"); length += 11)
            EXPECT_NE(error_of(whole.substr(0, length)), "") << length << " of " << whole.size();
    }
}

TEST(Gmsh, NamesTheLineAtFault)
{
    const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    const std::string some = head + "$Nodes\n1\n1 0 0 0\n$EndNodes\n$Elements\n1\n";
    EXPECT_EQ(error_of("hello\n"), "line 1: not a Gmsh mesh, which begins with $MeshFormat");
    EXPECT_EQ(error_of("$MeshFormat\n3 0 8\n"), "line 2: version 3 of Gmsh's format is not read; 2.2, 4.0 and 4.1 are");
    EXPECT_EQ(error_of(head + "hello\n"), "line 4: \"hello\" stands where a section should");
    EXPECT_EQ(error_of(head + "$Nodes\n99999999999\n1 0 0 0\n"),
              "line 5: a count of 99999999999 does not fit the rest of the file");
    EXPECT_EQ(error_of(head + "$Nodes\n1\n1 0 0 x\n"), "line 6: \"x\" is not a number that can be taken here");
    EXPECT_EQ(error_of(some + "1 4 0 1 1 1 2\n$EndElements\n"), "cell 0: there is no node 2");
    EXPECT_EQ(error_of(some + "1 333 0 1\n$EndElements\n"), "line 10: elements of type 333 are not read");
    EXPECT_EQ(error_of(some + "1 15 0 1\n"), "line 10: there is no $EndElements");
    EXPECT_EQ(error_of(head), "there are no cells in it");
}
