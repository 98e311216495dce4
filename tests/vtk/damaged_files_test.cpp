// Files of VTK's formats whose numbers do not fit each other.

#include "tests/fuzz/mutation.h"
#include "tests/fuzz/seeds.h"
#include "tests/reading_error.h"
#include "tests/temporary_folder.h"
#include "vtu_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

using namespace visorder;
using namespace visorder::tests;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace {

const TemporaryFolder folder;

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
}

/// What reading complains of: what is wrong, and not that VTK crashed.
void expect_refused(const std::string& name, const std::string& content, const std::string& part)
{
    SCOPED_TRACE(content.size() < 2000 ? content : name);
    EXPECT_THAT(reading_error(folder.write(name, content)),
                AllOf(StartsWith("cannot be read: "), HasSubstr(part), Not(HasSubstr("crashed"))));
}

const std::string legacy_start = "# vtk DataFile Version 3.0\ntitle\nASCII\n";
const std::string legacy_points = "DATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n0 0 0 1 0 0\n0 1 0 0 0 1 1 1 1\n";
const std::string legacy_cells = "CELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\n";
const std::string legacy_types = "CELL_TYPES 2\n10\n10\n";
const std::string legacy = legacy_start + legacy_points + legacy_cells + legacy_types;

void expect_legacy_refused(const std::string& what, const std::string& by, const std::string& part)
{
    expect_refused("mesh.vtk", replaced(legacy, what, by), part);
}

const std::string legacy_5 = "# vtk DataFile Version 5.1\ntitle\nASCII\n" + legacy_points +
                             "CELLS 3 8\nOFFSETS vtktypeint64\n0 4 8\nCONNECTIVITY vtktypeint64\n0 1 2 3 1 2 3 4\n" +
                             legacy_types;

void expect_legacy_5_refused(const std::string& what, const std::string& by, const std::string& part)
{
    expect_refused("mesh.vtk", replaced(legacy_5, what, by), part);
}

/// A tetrahedron in binary, of either byte order. VTK's is big-endian.
std::string binary_tetrahedron(bool big_endian)
{
    std::string content = "# vtk DataFile Version 3.0\ntitle\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 int\n";
    const auto append = [&](std::initializer_list<unsigned> numbers) {
        for (const unsigned number : numbers)
            for (int i = 0; i < 4; ++i)
                content += static_cast<char>(number >> 8 * (big_endian ? 3 - i : i));
    };
    append({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    content += "\nCELLS 1 5\n";
    append({4, 0, 1, 2, 3});
    content += "\nCELL_TYPES 1\n";
    append({10});
    return content + "\n";
}

std::string vtu()
{
    VtuText text = vtu_of_two_tetrahedra();
    text.point_arrays = {{"s", 1, {0, 1, 2, 3, 4}}};
    return text.str();
}

void expect_vtu_refused(const std::string& what, const std::string& by, const std::string& part)
{
    expect_refused("mesh.vtu", replaced(vtu(), what, by), part);
}

/// A tetrahedron as a polyhedron, with these faces that end there.
std::string polyhedron(const std::string& faces, const std::string& ends)
{
    std::string text = replaced(vtu(), "10 10</DataArray>", "42 10</DataArray>");
    return replaced(
        text, "</Cells>",
        fmt::format("<DataArray type=\"Int64\" Name=\"faces\" format=\"ascii\">{}</DataArray>"
                    "<DataArray type=\"Int64\" Name=\"faceoffsets\" format=\"ascii\">{}</DataArray></Cells>",
                    faces, ends));
}

/// The first seed of that name, which is valid.
std::string seed(const std::string& name)
{
    for (const Seed& candidate : seeds_of(name))
        return candidate.content;
    ADD_FAILURE() << name;
    return "";
}

} // namespace

TEST(DamagedFiles, TheseAreNone)
{
    EXPECT_EQ(reading_error(folder.write("mesh.vtk", legacy)), "");
    EXPECT_EQ(reading_error(folder.write("mesh.vtk", legacy_5)), "");
    EXPECT_EQ(reading_error(folder.write("mesh.vtk", binary_tetrahedron(true))), "");
    EXPECT_EQ(reading_error(folder.write("mesh.vtu", vtu())), "");
    for (const char* ending : {".vtk", ".vtu", ".e"})
        for (const Seed& seed : seeds_of(ending))
            EXPECT_EQ(reading_error(folder.write(seed.name, seed.content)), "") << seed.name;
}

TEST(DamagedFiles, LegacyCountsOfCells)
{
    expect_legacy_refused("CELLS 2 10", "CELLS 3 10", "its numbers end in cell 2");
    expect_legacy_refused("CELLS 2 10", "CELLS 1 10", "its 1 cells take 5");
    expect_legacy_refused("CELLS 2 10", "CELLS -2 10", "-2");
    expect_legacy_refused("CELLS 2 10", "CELLS 2 -10", "-10");
    expect_legacy_refused("CELLS 2 10", "CELLS 2 0", "2 cells in 0 numbers");
    expect_legacy_refused("CELLS 2 10", "CELLS 2 1000", "1000 numbers");
    expect_legacy_refused("CELLS 2 10", "CELLS 900000000000 10", "900000000000 cells");
    expect_legacy_refused("CELLS 2 10", "CELLS 2 9223372036854775807", "9223372036854775807 numbers");
    expect_legacy_refused("CELLS 2 10", "CELLS 2 99999999999999999999", "99999999999999999999");
    expect_legacy_refused("4 0 1 2 3", "9 0 1 2 3", "its numbers end in cell 1");
    expect_legacy_refused("4 0 1 2 3", "900000000 0 1 2 3", "cell 0 has 900000000 points");
    expect_legacy_refused("4 0 1 2 3", "-4 0 1 2 3", "cell 0 has -4 points");
    expect_legacy_refused("4 0 1 2 3", "4 0 1 x 3", "\"x\"");
    expect_legacy_refused("CELL_TYPES 2\n10\n", "CELL_TYPES 1\n", "2 cells, but 1 cell types");
    expect_legacy_refused("CELL_TYPES 2\n10", "CELL_TYPES 2\n300", "no cell type 300");
    expect_legacy_refused("CELL_TYPES 2\n10", "CELL_TYPES 2\n-1", "no cell type -1");
    expect_legacy_refused(legacy_types, "", "2 cells, but 0 cell types");
    expect_legacy_refused(legacy_types, legacy_types + "CELLS 1 5\n4 0 1 2 3\n", "two sections of CELLS");
}

TEST(DamagedFiles, LegacyPointsOfCells)
{
    expect_legacy_refused("4 1 2 3 4", "4 1 2 3 5", "cell 1: there is no point 5");
    expect_legacy_refused("4 1 2 3 4", "4 1 2 3 4294967300", "cell 1: there is no point 4294967300");
    expect_legacy_refused("4 0 1 2 3", "4 0 1 2 -1", "cell 0: there is no point -1");
    expect_legacy_5_refused("1 2 3 4", "1 2 3 4294967300", "cell 1: there is no point 4294967300");
}

TEST(DamagedFiles, LegacyOffsetsOfCells)
{
    expect_legacy_5_refused("0 4 8", "0 4 80", "offset 2 is 80");
    expect_legacy_5_refused("0 4 8", "-4 4 8", "offset 0 is -4");
    expect_legacy_5_refused("0 4 8", "0 8 4", "offset 2 is 4");
    expect_legacy_5_refused("0 4 8", "0 4 7", "the last offset is 7");
    expect_legacy_5_refused("0 4 8", "4 4 8", "offset 0 is 4");
    expect_legacy_5_refused("CELLS 3 8", "CELLS 2 8", "in the place of connectivity");
    expect_legacy_5_refused("CELLS 3 8", "CELLS 3 800000000", "800000000");
    expect_legacy_5_refused("OFFSETS vtktypeint64", "OFFSETS float", "float");
}

TEST(DamagedFiles, LegacyCountsOfPointsAndValues)
{
    expect_legacy_refused("POINTS 5", "POINTS -5", "-5");
    expect_legacy_refused("POINTS 5", "POINTS 500000000000", "500000000000");
    expect_legacy_refused("POINTS 5", "POINTS 9223372036854775807", "9223372036854775807");
    expect_legacy_refused("POINTS 5", "POINTS 3", "0 is not a section");
    expect_legacy_refused("POINTS 5 float", "POINTS 5 flat", "flat");
    const auto with_data = [](const std::string& data) { return legacy + data; };
    expect_refused("mesh.vtk", with_data("POINT_DATA 6\nSCALARS s float\nLOOKUP_TABLE default\n1 2 3 4 5 6\n"),
                   "POINT_DATA is of 6 points, but there are 5");
    expect_refused("mesh.vtk", with_data("CELL_DATA 1\nSCALARS s float\nLOOKUP_TABLE default\n1\n"),
                   "CELL_DATA is of 1 cells, but there are 2");
    expect_refused("mesh.vtk", with_data("POINT_DATA 5\nSCALARS s float 1000000000\nLOOKUP_TABLE default\n1\n"),
                   "1000000000 components");
    expect_refused("mesh.vtk", with_data("POINT_DATA 5\nSCALARS s float -1\nLOOKUP_TABLE default\n1\n"), "\"-1\"");
    expect_refused("mesh.vtk", with_data("POINT_DATA 5\nFIELD f 1\na 2147483647 2147483647 float\n1\n"),
                   "2147483647 components");
    expect_refused("mesh.vtk", with_data("POINT_DATA 5\nFIELD f 1000000000\na 1 1 float\n1\n"), "FIELD");
    expect_refused("mesh.vtk", with_data("POINT_DATA 5\nLOOKUP_TABLE t -7\n"), "-7");
    expect_refused("mesh.vtk", with_data("POINT_DATA 5\nLOOKUP_TABLE t 700000000\n"), "700000000");
    std::string turns;
    for (int i = 0; i < 1000; ++i)
        turns += "POINT_DATA 5 CELL_DATA 2 ";
    expect_refused("mesh.vtk", with_data(turns), "more than 100 sections");
}

TEST(DamagedFiles, LegacyByteOrder)
{
    expect_refused("mesh.vtk", binary_tetrahedron(false), "it may not be big-endian");
}

TEST(DamagedFiles, LegacyPolyhedra)
{
    const auto file = [](const std::string& cells, const std::string& types) {
        return replaced(replaced(legacy, legacy_cells, cells), "CELL_TYPES 2\n10\n10", types);
    };
    expect_refused("mesh.vtk", file("CELLS 2 10\n4 900 1 2 3\n4 1 2 3 4\n", "CELL_TYPES 2\n42\n10"),
                   "cell 0: the faces of the polyhedron go beyond its 4 numbers");
    expect_refused("mesh.vtk", file("CELLS 1 6\n5 1 3 0 1 77\n", "CELL_TYPES 1\n42"), "cell 0: there is no point 77");
    expect_refused("mesh.vtk", file("CELLS 1 6\n5 1 3 0 1 -1\n", "CELL_TYPES 1\n42"), "cell 0: there is no point -1");
    expect_refused("mesh.vtk", file("CELLS 1 7\n6 1 3 0 1 2 0\n", "CELL_TYPES 1\n42"), "cell 0");
    expect_refused("mesh.vtk", file("CELLS 1 1\n0\n", "CELL_TYPES 1\n42"), "cell 0");
}

TEST(DamagedFiles, LegacyGrids)
{
    for (const std::string size :
         {"DIMENSIONS -2 2 2", "DIMENSIONS 3000000000 1 1", "DIMENSIONS 60000 60000 60000", ""})
        for (const std::string kind : {"STRUCTURED_POINTS", "STRUCTURED_GRID", "RECTILINEAR_GRID"})
            expect_refused("mesh.vtk", legacy_start + "DATASET " + kind + "\n" + size + "\n", "");
    expect_refused("mesh.vtk",
                   legacy_start + "DATASET STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 3 float\n0 0 0 0 0 0 0 0 0\n",
                   "3 points are not the 2 x 2 x 2");
    expect_refused("mesh.vtk",
                   legacy_start + "DATASET RECTILINEAR_GRID\nDIMENSIONS 2 2 2\nX_COORDINATES 2 float\n0 1\n",
                   "coordinates of all three axes");
    expect_refused("mesh.vtk",
                   legacy_start + "DATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0 0 1 0 1 1 0\nPOLYGONS 2 8\n7 0 1 2\n"
                                  "3 1 2 3\n",
                   "POLYGONS");
}

TEST(DamagedFiles, VtuCounts)
{
    expect_vtu_refused("NumberOfPoints=\"5\"", "NumberOfPoints=\"-5\"", "NumberOfPoints is -5");
    expect_vtu_refused("NumberOfPoints=\"5\"", "NumberOfPoints=\"10000000000000\"", "10000000000000");
    expect_vtu_refused("NumberOfPoints=\"5\"", "NumberOfPoints=\"4000000000\"", "too short");
    expect_vtu_refused("NumberOfPoints=\"5\"", "NumberOfPoints=\"500\"", "too short for 500 points");
    expect_vtu_refused("NumberOfCells=\"2\"", "NumberOfCells=\"-1\"", "NumberOfCells is -1");
    expect_vtu_refused("NumberOfCells=\"2\"", "NumberOfCells=\"2147483647\"", "too short");
    for (const char* components : {"-1", "2147483648", "1000000000", "4294967295", "9223372036854775807"}) {
        expect_vtu_refused("Name=\"s\" NumberOfComponents=\"1\"",
                           fmt::format("Name=\"s\" NumberOfComponents=\"{}\"", components), "\"s\" has");
        expect_vtu_refused("Name=\"Points\" NumberOfComponents=\"3\"",
                           fmt::format("Name=\"Points\" NumberOfComponents=\"{}\"", components), "\"Points\" has");
    }
    for (const char* offsets : {"4 800000000", "-4 8", "8 4"})
        expect_vtu_refused(">4 8</DataArray>", fmt::format(">{}</DataArray>", offsets), "");
}

TEST(DamagedFiles, VtuPolyhedra)
{
    const std::string faces = "4 3 0 1 2 3 0 3 1 3 1 3 2 3 2 3 0";
    EXPECT_THAT(reading_error(folder.write("mesh.vtu", polyhedron(faces, "17 -1"))), Not(HasSubstr("crashed")));
    expect_refused("mesh.vtu", polyhedron("900 3 0 1 2", "5 -1"), "cell 0: the faces of the polyhedron go beyond");
    expect_refused("mesh.vtu", polyhedron("1 900 0 1 2", "5 -1"), "cell 0: the faces of the polyhedron go beyond");
    expect_refused("mesh.vtu", polyhedron(faces, "900 -1"), "cell 0: its faces end at 900 of 17 numbers");
    expect_refused("mesh.vtu", polyhedron(faces, "16 -1"), "cell 0");
    expect_refused("mesh.vtu", polyhedron(faces, "-7 -1"), "cell 0: its faces end at -7");
    expect_refused("mesh.vtu", polyhedron(replaced(faces, "3 0 1 2", "3 0 1 99"), "17 -1"),
                   "cell 0: there is no point 99");
    expect_refused("mesh.vtu", polyhedron(faces, "17 17"), "cell 1");
}

TEST(DamagedFiles, VtuBinaryHeaders)
{
    // In raw data a header of 8 bytes, the bytes that follow, comes before each array.
    std::string raw = seed("kinds_raw.vtu");
    raw.replace(raw.find('_', raw.find("<AppendedData")) + 1, 8, "\xff\xff\xff\xff\xff\xff\xff\x7f");
    expect_refused("mesh.vtu", raw, "says to have 9223372036854775807 bytes");
    // In compressed data: how many blocks, their bytes, those of the last, and for each how many it is compressed to.
    const std::string zlib = seed("kinds_raw_zlib.vtu");
    const std::size_t header = zlib.find('_', zlib.find("<AppendedData")) + 1;
    for (const std::size_t number : {0u, 1u, 2u, 3u}) {
        std::string content = zlib;
        content.replace(header + 4 * number, 4, "\xff\xff\xff\x7f");
        expect_refused("mesh.vtu", content, "array");
    }
    std::string no_blocks = zlib;
    no_blocks.replace(header + 4, 4, std::string(4, '\0'));
    expect_refused("mesh.vtu", no_blocks, "blocks of 0 bytes");
    expect_refused("mesh.vtu", replaced(zlib, "offset=\"0\"", "offset=\"99999999\""), "begins at 99999999");
    expect_refused("mesh.vtu", replaced(zlib, "offset=\"0\"", "offset=\"-1\""), "begins at -1");
}

TEST(DamagedFiles, VtuNestedTooDeep)
{
    std::string deep = "<VTKFile type=\"UnstructuredGrid\">";
    for (int i = 0; i < 100000; ++i)
        deep += "<a>";
    expect_refused("mesh.vtu", deep, "nested");
}

TEST(DamagedFiles, CutShortAnywhere)
{
    for (const char* ending : {".vtk", ".vtu", ".e"})
        for (const Seed& seed : seeds_of(ending))
            for (std::size_t part = 1; part < 4; ++part) {
                const std::size_t length = seed.content.size() * part / 4 + part;
                reading_error(folder.write("cut" + std::string(ending), seed.content.substr(0, length)));
            }
}

TEST(DamagedFiles, AnyDamageIsSaidInOneLine)
{
    for (const char* ending : {".vtk", ".vtu", ".e"}) {
        std::vector<std::string> contents;
        for (const Seed& seed : seeds_of(ending))
            contents.push_back(seed.content);
        for (std::uint64_t number = 0; number < 40; ++number) {
            SCOPED_TRACE(fmt::format("mutation {} of {}", number, ending));
            reading_error(folder.write("damaged" + std::string(ending), mutated(contents, number)));
        }
    }
}
