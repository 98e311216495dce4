#include "tests/reading_error.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <gmock/gmock.h>

using namespace visorder;
using namespace visorder::tests;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

const TemporaryFolder folder;

/// How a Plot3D file is written.
struct Writing {
    bool swapped;
    bool counted;
    bool fortran;
    bool doubles;
};

class Records {
public:
    explicit Records(const Writing& writing) : writing_(writing) {}

    Records& integer(std::int32_t value) { return raw(value); }
    Records& real(double value) { return writing_.doubles ? raw(value) : raw(static_cast<float>(value)); }
    Records& end()
    {
        std::string record;
        std::swap(record, record_);
        const auto bytes = static_cast<std::int32_t>(record.size());
        if (writing_.fortran)
            raw(bytes);
        record_ += record;
        if (writing_.fortran)
            raw(bytes);
        file_ += record_;
        record_.clear();
        return *this;
    }
    const std::string& file() const { return file_; }

private:
    template <class T>
    Records& raw(T value)
    {
        std::string bytes(sizeof(T), '\0');
        std::memcpy(bytes.data(), &value, sizeof(T));
        if (writing_.swapped)
            std::reverse(bytes.begin(), bytes.end());
        record_ += bytes;
        return *this;
    }

    Writing writing_;
    std::string record_;
    std::string file_;
};

constexpr int points = 3 * 2 * 2;

void write_size(Records& records, const Writing& writing)
{
    if (writing.counted)
        records.integer(1).end();
    records.integer(3).integer(2).integer(2).end();
}

/// Unit cubes side by side along x; `blanks` has one integer a point, or none.
std::string grid(const Writing& writing, const std::vector<int>& blanks = {})
{
    Records records(writing);
    write_size(records, writing);
    for (int i = 0; i < points; ++i)
        records.real(i % 3);
    for (int i = 0; i < points; ++i)
        records.real(i / 3 % 2);
    for (int i = 0; i < points; ++i)
        records.real(i / 6);
    for (const int blank : blanks)
        records.integer(blank);
    return records.end().file();
}

/// Point i has density i, momentum (0, 3, 4) and energy 100 + i.
std::string solution(const Writing& writing)
{
    Records records(writing);
    write_size(records, writing);
    for (int i = 0; i < 4; ++i)
        records.real(-1);
    records.end();
    for (int i = 0; i < points; ++i)
        records.real(i);
    for (const int momentum : {0, 3, 4})
        for (int i = 0; i < points; ++i)
            records.real(momentum);
    for (int i = 0; i < points; ++i)
        records.real(100 + i);
    return records.end().file();
}

std::vector<Writing> all_writings()
{
    std::vector<Writing> all;
    for (const bool swapped : {false, true})
        for (const bool counted : {false, true})
            for (const bool fortran : {false, true})
                for (const bool doubles : {false, true})
                    all.push_back({swapped, counted, fortran, doubles});
    return all;
}

constexpr Writing plain{};

} // namespace

TEST(Plot3d, FindsOutEveryLayout)
{
    for (const Writing& writing : all_writings())
        for (const std::vector<int>& blanks : {std::vector<int>{}, std::vector<int>(points, -1)}) {
            SCOPED_TRACE(testing::Message()
                         << writing.swapped << writing.counted << writing.fortran << writing.doubles << blanks.size());
            const auto path = folder.write("axyz.bin", grid(writing, blanks));
            folder.write("aq.bin", solution(writing));
            const MeshFile file = read_mesh(path);
            EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::hexahedron, CellShape::hexahedron));
            EXPECT_THAT(file.mesh.cell(1), ElementsAre(1, 2, 5, 4, 7, 8, 11, 10));
            EXPECT_EQ(file.mesh.points[11], glm::dvec3(2, 1, 1));
            EXPECT_EQ(file.scalar, "Density");
            EXPECT_THAT(file.mesh.scalars, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
            EXPECT_THAT(file.notes, IsEmpty());
            EXPECT_THAT(read_mesh(path, {.scalar = "Momentum"}).mesh.scalars, Each(5));
            EXPECT_EQ(read_mesh(path, {.scalar = "StagnationEnergy"}).mesh.scalars[3], 103);
            EXPECT_EQ(reading_error(path, {.scalar = "Pressure"}),
                      "no scalar \"Pressure\"; it has: Density, Momentum, StagnationEnergy");
        }
}

TEST(Plot3d, LeavesOutCellsWithBlankedPoints)
{
    std::vector<int> blanks(points, 1);
    blanks[3] = 0;
    const MeshFile file = read_mesh(folder.write("blankxyz.bin", grid(plain, blanks)));
    EXPECT_THAT(file.mesh.cell_count(), 1u);
    EXPECT_THAT(file.notes, ElementsAre(HasSubstr("no scalars: there is no "), "1 hidden cells left out",
                                        "4 points that no cell uses left out"));
}

TEST(Plot3d, HasNoScalarsWithoutASolution)
{
    const auto path = folder.write("lonelyxyz.bin", grid(plain));
    const MeshFile file = read_mesh(path);
    EXPECT_EQ(file.scalar, "");
    EXPECT_THAT(file.mesh.scalars, IsEmpty());
    EXPECT_THAT(file.notes, ElementsAre("no scalars: there is no " + folder.file("lonelyq.bin").string()));
    EXPECT_EQ(reading_error(path, {.scalar = "Density"}), "no scalar \"Density\"; it has: none");
}

TEST(Plot3d, TakesASolutionPaddedToABlock)
{
    const auto path = folder.write("paddedxyz.bin", grid(plain));
    folder.write("paddedq.bin", solution(plain) + std::string(200, '\0'));
    EXPECT_THAT(read_mesh(path).mesh.scalars, SizeIs(points));
}

TEST(Plot3d, RefusesFilesCutShort)
{
    const std::string whole_grid = grid(plain);
    const std::string whole_solution = solution(plain);
    for (std::size_t length = 0; length < whole_grid.size(); ++length)
        EXPECT_EQ(reading_error(folder.write("cutxyz.bin", whole_grid.substr(0, length))),
                  "cannot be read: its length is that of no Plot3D file");
    const auto path = folder.write("cutxyz.bin", whole_grid);
    for (std::size_t length = 0; length < whole_solution.size(); ++length) {
        const auto cut = folder.write("cutq.bin", whole_solution.substr(0, length));
        try {
            read_mesh(path);
            ADD_FAILURE() << length;
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), cut.string() + ": cannot be read: it is cut short, or not laid out as its grid is");
        }
    }
}

TEST(Plot3d, RefusesTheSolutionOfAnotherGrid)
{
    const auto path = folder.write("otherxyz.bin", grid(plain));
    std::string other = solution(plain);
    std::swap(other[0], other[8]); // 2 x 2 x 3
    const auto solution_path = folder.write("otherq.bin", other);
    try {
        read_mesh(path);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(), solution_path.string() + ": its 2 x 2 x 3 points are not the 3 x 2 x 2 of its grid");
    }
}

TEST(Plot3d, RefusesWhatIsNoGrid)
{
    for (const std::string& content : {std::string("hello"), std::string(3000, 'a'), std::string(12, '\0'),
                                       std::string(3000, '\0'), std::string(3000, '\xff')})
        EXPECT_EQ(reading_error(folder.write("noxyz.bin", content)),
                  "cannot be read: its length is that of no Plot3D file");
    EXPECT_THAT(reading_error(folder.write("aq.bin", solution(plain))), HasSubstr("not a name of a mesh file"));
}

namespace {

/// Two grids of unit cubes, 3 x 2 x 2 points and 2 x 2 x 2, the second on the side x = 2 of the first.
constexpr std::array<std::array<int, 3>, 2> sizes{{{3, 2, 2}, {2, 2, 2}}};

int count(std::size_t zone)
{
    return sizes[zone][0] * sizes[zone][1] * sizes[zone][2];
}

std::string two_grids(const Writing& writing, bool is_solution, bool blanks)
{
    Records records(writing);
    records.integer(2).end();
    for (const auto& size : sizes)
        for (const int along : size)
            records.integer(along);
    records.end();
    for (std::size_t zone = 0; zone < 2; ++zone) {
        if (is_solution) {
            records.real(1).real(2).real(3).real(4).end();
            for (int k = 0; k < 5; ++k)
                for (int i = 0; i < count(zone); ++i)
                    records.real(k == 0 ? 100 * static_cast<int>(zone) + i : 0);
        } else {
            for (int i = 0; i < count(zone); ++i)
                records.real(i % sizes[zone][0] + 2 * static_cast<int>(zone));
            for (int i = 0; i < count(zone); ++i)
                records.real(i / sizes[zone][0] % 2);
            for (int i = 0; i < count(zone); ++i)
                records.real(i / (2 * sizes[zone][0]));
            for (int i = 0; blanks && i < count(zone); ++i)
                records.integer(zone == 0 && i == 0 ? 0 : 1);
        }
        records.end();
    }
    return records.file();
}

} // namespace

TEST(Plot3d, JoinsSeveralGridsWhereTheirPointsAreEqual)
{
    for (const Writing& writing : all_writings())
        for (const bool blanks : {false, true}) {
            const auto path = folder.write("twoxyz.bin", two_grids(writing, false, blanks));
            folder.write("twoq.bin", two_grids(writing, true, false));
            const MeshFile file = read_mesh(path);
            EXPECT_THAT(file.mesh.shapes, SizeIs(blanks ? 2 : 3));
            EXPECT_EQ(file.mesh.points.size(), blanks ? 12u : 16u);
            EXPECT_THAT(file.file_cells,
                        blanks ? testing::ElementsAreArray({1u, 2u}) : testing::ElementsAreArray({0u, 1u, 2u}));
            EXPECT_THAT(file.notes,
                        testing::Contains("4 points joined with those of other pieces at the same coordinates"));
            EXPECT_EQ(file.mesh.scalars.back(), 107);
            ASSERT_THAT(file.blocks, SizeIs(2));
            EXPECT_EQ(file.blocks[1].name, "grid 2");
            EXPECT_EQ(file.blocks[1].first_file_cell, 2u);
        }
}

TEST(Plot3d, FindsPrecisionByteOrderAndRecordsOfTheSolutionByItself)
{
    for (const Writing& grid_writing : all_writings())
        for (const Writing& solution_writing : all_writings()) {
            const auto path = folder.write("mixedxyz.bin", grid(grid_writing));
            folder.write("mixedq.bin", solution(solution_writing));
            EXPECT_THAT(read_mesh(path).mesh.scalars, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
        }
}

TEST(Plot3d, ReadsText)
{
    const std::string coordinates = "0 1 2 0 1 2 0 1 2 0 1 2\n3*0. 3*1.0E0 3*0 3*1d0\n6*0, 6*1\n";
    const std::string values = "0.1 0 1e5 0\n0 1 2 3 4 5 6 7 8 9 10 11\n12*0 12*3 12*4 12*7\n";
    for (const std::string counted : {"", "1\n"}) {
        const auto path = folder.write("textxyz.bin", counted + "3 2 2\n" + coordinates);
        folder.write("textq.bin", counted + "3 2 2\n" + values);
        const MeshFile file = read_mesh(path);
        EXPECT_THAT(file.mesh.cell(1), ElementsAre(1, 2, 5, 4, 7, 8, 11, 10));
        EXPECT_EQ(file.mesh.points[11], glm::dvec3(2, 1, 1));
        EXPECT_THAT(file.mesh.scalars, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11));
        EXPECT_THAT(read_mesh(path, {.scalar = "Momentum"}).mesh.scalars, Each(5));
    }
    const auto blanked = folder.write("blanktextxyz.bin", "3 2 2\n" + coordinates + "0 11*1\n");
    EXPECT_THAT(read_mesh(blanked).file_cells, ElementsAre(1));
    for (const std::string text : {"3 2 2\n1 2 3", "3 2 2", "0 0 0", "99999 99999 99999", "2 3 2 2"})
        EXPECT_EQ(reading_error(folder.write("badxyz.bin", text)),
                  "cannot be read: its length is that of no Plot3D file");
}

TEST(Plot3d, ReadsGridsInThePlane)
{
    Records grid_records(plain), solution_records(plain);
    grid_records.integer(2).integer(2);
    for (const double coordinate : {0, 1, 0, 1, 0, 0, 1, 1})
        grid_records.real(coordinate);
    solution_records.integer(2).integer(2).real(0).real(0).real(0).real(0);
    for (int i = 0; i < 16; ++i)
        solution_records.real(i);
    const auto path = folder.write("planexyz.bin", grid_records.end().file());
    folder.write("planeq.bin", solution_records.end().file());
    const MeshFile file = read_mesh(path);
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 3, 0, 3, 2));
    EXPECT_THAT(file.mesh.scalars, ElementsAre(0, 1, 2, 3));
    EXPECT_EQ(read_mesh(path, {.scalar = "StagnationEnergy"}).mesh.scalars[3], 15);
}

TEST(Plot3d, KnowsTheNamesOfItsFiles)
{
    for (const auto& [grid_name, solution_name] :
         {std::pair{"a.xyz", "a.q"}, {"b.x", "b.q"}, {"c.p3d", "c.q"}, {"D.XYZ", "D.Q"}, {"Exyz.bin", "Eq.bin"}}) {
        folder.write(solution_name, solution(plain));
        EXPECT_THAT(read_mesh(folder.write(grid_name, grid(plain))).mesh.scalars, SizeIs(points)) << grid_name;
    }
}
