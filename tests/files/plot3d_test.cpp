#include "tests/reading_error.h"
#include "tests/temporary_folder.h"

#include <algorithm>
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
