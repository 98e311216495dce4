#include "tests/reading_error.h"
#include "tests/temporary_folder.h"

#include <cmath>
#include <gmock/gmock.h>
#include <vtk_netcdf.h>

using namespace visorder;
using namespace visorder::tests;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

const TemporaryFolder folder;

/// Writes a netCDF file, whose calls must all succeed.
class NetcdfFile {
public:
    NetcdfFile(const std::filesystem::path& path, int format) { check(nc_create(path.c_str(), format, &id_)); }
    ~NetcdfFile() { check(nc_close(id_)); }
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;

    int dimension(const char* name, std::size_t length)
    {
        int dimension = 0;
        check(nc_def_dim(id_, name, length, &dimension));
        return dimension;
    }
    int variable(const char* name, nc_type type, const std::vector<int>& dimensions)
    {
        int variable = 0;
        check(nc_def_var(id_, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &variable));
        return variable;
    }
    void attribute(int variable, const char* name, const std::string& text)
    {
        check(nc_put_att_text(id_, variable, name, text.size(), text.c_str()));
    }
    void attribute(const char* name, float value)
    {
        check(nc_put_att_float(id_, NC_GLOBAL, name, NC_FLOAT, 1, &value));
    }
    void attribute(const char* name, int value) { check(nc_put_att_int(id_, NC_GLOBAL, name, NC_INT, 1, &value)); }
    void end_definitions() { check(nc_enddef(id_)); }
    void put(int variable, const std::vector<double>& values)
    {
        check(nc_put_var_double(id_, variable, values.data()));
    }
    void put(int variable, const std::vector<int>& values) { check(nc_put_var_int(id_, variable, values.data())); }
    void put(int variable, const std::vector<std::string>& names, std::size_t length)
    {
        std::string all;
        for (std::string name : names) {
            name.resize(length);
            all += name;
        }
        check(nc_put_var_text(id_, variable, all.data()));
    }
    void put_record(int variable, std::size_t record, const std::vector<double>& values)
    {
        const std::array<std::size_t, 2> start{record, 0};
        const std::array<std::size_t, 2> count{1, values.size()};
        check(nc_put_vara_double(id_, variable, start.data(), count.data(), values.data()));
    }

private:
    static void check(int error) { ASSERT_EQ(error, NC_NOERR) << nc_strerror(error); }

    int id_ = 0;
};

/// Two unit cubes along x in blocks of their own, which share the four points of x = 1; a thirteenth point that none
/// uses; at two times the point data Temp (the point's number, then 0) and displacements; the cell data Both (1 and 3),
/// and Second, which the first block does not have.
std::filesystem::path write_two_blocks(const std::string& name, int format = 0)
{
    const std::filesystem::path path = folder.file(name);
    NetcdfFile file(path, NC_CLOBBER | format);
    file.attribute("api_version", 5.22f);
    file.attribute("version", 5.22f);
    file.attribute("floating_point_word_size", 8);
    file.attribute("file_size", 1);
    file.attribute(NC_GLOBAL, "title", "two blocks");

    const int time_step = file.dimension("time_step", NC_UNLIMITED);
    const int len_string = file.dimension("len_string", 33);
    file.dimension("num_dim", 3);
    const int num_nodes = file.dimension("num_nodes", 13);
    file.dimension("num_elem", 2);
    const int num_el_blk = file.dimension("num_el_blk", 2);
    const int num_el_in_blk1 = file.dimension("num_el_in_blk1", 1);
    const int num_nod_per_el1 = file.dimension("num_nod_per_el1", 8);
    const int num_el_in_blk2 = file.dimension("num_el_in_blk2", 1);
    const int num_nod_per_el2 = file.dimension("num_nod_per_el2", 8);
    const int num_nod_var = file.dimension("num_nod_var", 4);
    const int num_elem_var = file.dimension("num_elem_var", 2);

    const int time = file.variable("time_whole", NC_DOUBLE, {time_step});
    const int status = file.variable("eb_status", NC_INT, {num_el_blk});
    const int ids = file.variable("eb_prop1", NC_INT, {num_el_blk});
    file.attribute(ids, "name", "ID");
    const int x = file.variable("coordx", NC_DOUBLE, {num_nodes});
    const int y = file.variable("coordy", NC_DOUBLE, {num_nodes});
    const int z = file.variable("coordz", NC_DOUBLE, {num_nodes});
    const int connect1 = file.variable("connect1", NC_INT, {num_el_in_blk1, num_nod_per_el1});
    file.attribute(connect1, "elem_type", "HEX8");
    const int connect2 = file.variable("connect2", NC_INT, {num_el_in_blk2, num_nod_per_el2});
    file.attribute(connect2, "elem_type", "HEX8");
    const int node_names = file.variable("name_nod_var", NC_CHAR, {num_nod_var, len_string});
    const int temp = file.variable("vals_nod_var1", NC_DOUBLE, {time_step, num_nodes});
    std::vector<int> displacements;
    for (const char* variable : {"vals_nod_var2", "vals_nod_var3", "vals_nod_var4"})
        displacements.push_back(file.variable(variable, NC_DOUBLE, {time_step, num_nodes}));
    const int element_names = file.variable("name_elem_var", NC_CHAR, {num_elem_var, len_string});
    const int table = file.variable("elem_var_tab", NC_INT, {num_el_blk, num_elem_var});
    const int both1 = file.variable("vals_elem_var1eb1", NC_DOUBLE, {time_step, num_el_in_blk1});
    const int both2 = file.variable("vals_elem_var1eb2", NC_DOUBLE, {time_step, num_el_in_blk2});
    const int second2 = file.variable("vals_elem_var2eb2", NC_DOUBLE, {time_step, num_el_in_blk2});
    file.end_definitions();

    file.put(status, std::vector{1, 1});
    file.put(ids, std::vector{10, 20});
    file.put(x, std::vector<double>{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 9});
    file.put(y, std::vector<double>{0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1, 9});
    file.put(z, std::vector<double>{0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 9});
    file.put(connect1, std::vector{1, 2, 5, 4, 7, 8, 11, 10});
    file.put(connect2, std::vector{2, 3, 6, 5, 8, 9, 12, 11});
    file.put(node_names, {"Temp", "DISPLX", "DISPLY", "DISPLZ"}, 33);
    file.put(element_names, {"Both", "Second"}, 33);
    file.put(table, std::vector{1, 0, 1, 1});
    for (std::size_t step = 0; step < 2; ++step) {
        const std::vector<double> zeros(13);
        file.put_record(time, step, {double(step)});
        file.put_record(temp, step, step == 0 ? std::vector<double>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12} : zeros);
        for (const int displacement : displacements)
            file.put_record(displacement, step, std::vector<double>(13, 0.5));
        file.put_record(both1, step, {1});
        file.put_record(both2, step, {3});
        file.put_record(second2, step, {7});
    }
    return path;
}

} // namespace

TEST(Exodus, SharesPointsBetweenBlocks)
{
    for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
        const MeshFile file = read_mesh(write_two_blocks("blocks.exo", format), {.scalar = "Temp"});
        EXPECT_THAT(file.mesh.points, SizeIs(12));
        EXPECT_THAT(file.mesh.shapes, ElementsAre(CellShape::hexahedron, CellShape::hexahedron));
        EXPECT_THAT(file.mesh.cell(0), ElementsAre(0, 1, 4, 3, 6, 7, 10, 9));
        EXPECT_THAT(file.mesh.cell(1), ElementsAre(1, 2, 5, 4, 7, 8, 11, 10));
        EXPECT_THAT(file.notes,
                    ElementsAre("time step 1 (from 0) of 2, at time 1", "1 points that no cell uses left out"));
        EXPECT_THAT(file.file_cells, ElementsAre(0, 1));
        ASSERT_THAT(file.blocks, SizeIs(2));
        EXPECT_EQ(file.blocks[1].first_file_cell, 1u);
    }
}

TEST(Exodus, ReadsTheLastTimeStepWithoutDisplacements)
{
    const MeshFile file = read_mesh(write_two_blocks("blocks.e"), {.scalar = "Temp"});
    EXPECT_EQ(file.mesh.points[5], glm::dvec3(2, 1, 0));
    EXPECT_EQ(file.scalar, "Temp");
    EXPECT_THAT(file.mesh.scalars, Each(0));
}

TEST(Exodus, TakesAnArrayThatVariesRatherThanOneThatDoesNot)
{
    EXPECT_EQ(read_mesh(write_two_blocks("blocks.e"), {.time = "first"}).scalar, "Temp");
    EXPECT_EQ(read_mesh(write_two_blocks("blocks.e"), {.time = "last"}).scalar, "Both"); // Temp is 0 everywhere
}

TEST(Exodus, ReadsTheTimeStepAskedFor)
{
    const auto path = write_two_blocks("blocks.e");
    for (const std::string time : {"first", "index:0", "0", "0.0"}) {
        const MeshFile file = read_mesh(path, {.scalar = "Temp", .time = time});
        EXPECT_THAT(file.mesh.scalars, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11)) << time;
        EXPECT_EQ(file.notes.front(), "time step 0 (from 0) of 2, at time 0");
    }
    for (const std::string time : {"last", "index:1", "1"})
        EXPECT_THAT(read_mesh(path, {.scalar = "Temp", .time = time}).mesh.scalars, Each(0)) << time;
    for (const std::string time : {"index:2", "index:-1", "index:", "0.5", "hello", "nan"})
        EXPECT_EQ(reading_error(path, {.time = time}), "no time \"" + time + "\"; its 2 time steps are at 0, 1");
}

TEST(Exodus, AveragesElementDataOverBlocks)
{
    const MeshFile file = read_mesh(write_two_blocks("blocks.ex2"), {.scalar = "Both"});
    EXPECT_THAT(file.mesh.scalars, ElementsAre(1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2, 3));
}

TEST(Exodus, TakesElementDataOfSomeBlocksAsMissingElsewhere)
{
    const MeshFile file = read_mesh(write_two_blocks("blocks.ex2"), {.scalar = "Second"});
    for (std::size_t i = 0; i < 12; ++i)
        if (i % 3 == 0)
            EXPECT_TRUE(std::isnan(file.mesh.scalars[i])) << i;
        else
            EXPECT_EQ(file.mesh.scalars[i], 7) << i;
    EXPECT_THAT(file.notes, Contains("4 scalars are missing: they are not finite"));
    EXPECT_EQ(reading_error(write_two_blocks("blocks.ex2"), {.scalar = "Third"}),
              "no scalar \"Third\"; it has: Temp, DISPL, Both (of cells), Second (of cells)");
}

TEST(Exodus, KnowsItsOtherEndings)
{
    for (const char* name : {"blocks.g", "blocks.gen", "blocks.exoII", "blocks.exii", "blocks.ex2v2", "BLOCKS.EXO"})
        EXPECT_THAT(read_mesh(write_two_blocks(name)).mesh.shapes, SizeIs(2)) << name;
}

TEST(Exodus, RefusesAFileCutShortAnywhere)
{
    for (const int format : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
        const std::string whole = content_of(write_two_blocks("blocks.ex2", format));
        const ReadOptions here{.isolated = false}; // a process for each would take long
        for (std::size_t length = 0; length < whole.size(); length += 13)
            EXPECT_THAT(reading_error(folder.write("cut.ex2", whole.substr(0, length)), here),
                        HasSubstr("cannot be read"))
                << "format " << format << ", " << length << " of " << whole.size() << " bytes";
    }
}

TEST(Exodus, RefusesWhatIsNoExodusFile)
{
    EXPECT_THAT(reading_error(folder.write("text.ex2", "hello")), HasSubstr("cannot be read: NetCDF: "));
    EXPECT_THAT(reading_error(folder.write("empty.ex2", "")), HasSubstr("cannot be read"));
    {
        NetcdfFile file(folder.file("other.ex2"), NC_CLOBBER);
        file.dimension("x", 3);
        file.end_definitions();
    }
    EXPECT_EQ(reading_error(folder.file("other.ex2")), "cannot be read: a netCDF file, but not of Exodus II");
}
