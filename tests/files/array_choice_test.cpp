#include "files/array_choice.h"

#include "visorder/error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace visorder::tests {

using namespace detail;
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

FileArray array(const std::string& name, bool on_cells, std::vector<double> values, int components = 1)
{
    return {name, on_cells, components, false, [values] { return values; }};
}

std::string chosen(std::vector<FileArray> arrays, const std::string& name = "", const std::string& by_default = "")
{
    FileGrid grid;
    grid.path = "mesh.vtu";
    grid.arrays = std::move(arrays);
    grid.default_array = by_default;
    const FileArray* found = choose_array(grid, name);
    return found ? found->name : "none";
}

TEST(ArrayChoice, TakesActiveThenVaryingThenConstantOnes)
{
    FileArray ids = array("ids", false, {0, 1, 2});
    ids.holds_ids = true;
    const FileArray constant = array("constant", false, {3, nan, 3}), varying = array("varying", false, {nan, 1, 2}),
                    vectors = array("vectors", false, {1, 2, 3}, 3), of_cells = array("of cells", true, {4, 5});
    FileArray active = array("active", false, {7, 7, 7});
    active.active = true;
    EXPECT_EQ(chosen({ids, constant, vectors, of_cells, varying, active}), "active");
    EXPECT_EQ(chosen({ids, constant, vectors, of_cells, varying}), "varying");
    EXPECT_EQ(chosen({ids, constant, vectors, of_cells}), "of cells");
    EXPECT_EQ(chosen({ids, constant, vectors}), "vectors");
    EXPECT_EQ(chosen({ids, constant}), "constant");
    EXPECT_EQ(chosen({ids}), "none");
    FileArray counts = array("node_number", false, {1, 2, 3});
    counts.type = "long long";
    EXPECT_EQ(chosen({counts, varying}), "varying") << "one more from point to point";
    ids.active = true;
    EXPECT_EQ(chosen({ids, varying}), "varying") << "ids are no scalars, active or not";
    EXPECT_EQ(chosen({varying, constant}, "", "constant"), "varying") << "a default that does not vary";
    EXPECT_EQ(chosen({varying, vectors}, "", "vectors"), "vectors");
}

TEST(ArrayChoice, TakesTheNamedOneOrListsWhatThereIs)
{
    const std::vector<FileArray> arrays{array("a", true, {1}), array("b", false, {1}), array("b", true, {1})};
    EXPECT_EQ(chosen(arrays, "b"), "b");
    try {
        chosen(arrays, "c");
        FAIL() << "no exception";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "mesh.vtu: no scalar \"c\"; it has: a (of cells), b, b (of cells)");
    }
}

TEST(ArrayChoice, KnowsNamesOfIds)
{
    for (const char* name : {"id", "ids", "ID", "IDs", "GlobalNodeId", "vtkOriginalPointIds", "ObjectId", "block_id",
                             "CellEntityIds", "node ids", "vtkGhostType", "GlobalElementID"})
        EXPECT_TRUE(is_name_of_ids(name)) << name;
    for (const char* name : {"fluid", "solid", "humidity", "grid", "PYRAMID", "idle", "", "s", "pressure"})
        EXPECT_FALSE(is_name_of_ids(name)) << name;
}

TEST(ArrayChoice, SummarizesWhatIsFinite)
{
    const ArraySummary summary =
        summary_of(array("a", true, {nan, 5, -2, std::numeric_limits<double>::infinity(), 3}, 2));
    EXPECT_EQ(summary.lowest, -2);
    EXPECT_EQ(summary.highest, 5);
    EXPECT_EQ(summary.finite, 3u);
    EXPECT_EQ(summary.missing, 2u);
    EXPECT_EQ(summary.components, 2);
    EXPECT_TRUE(summary.on_cells);
}

TEST(ArrayChoice, MapsWhatSinglePrecisionWouldLose)
{
    const auto is_identity = [](const ScalarMap& map) { return map.offset == 0 && map.scale == 1; };
    EXPECT_TRUE(is_identity(scalar_map_of(std::vector<double>{})));
    EXPECT_TRUE(is_identity(scalar_map_of(std::vector<double>{nan, nan})));
    EXPECT_TRUE(is_identity(scalar_map_of(std::vector<double>{1e9, 1e9})));
    EXPECT_TRUE(is_identity(scalar_map_of(std::vector<double>{300, 310, nan})));
    EXPECT_TRUE(is_identity(scalar_map_of(std::vector<double>{-1e37, 1e37})));
    for (const std::vector<double>& values : {std::vector<double>{1e9, 1e9 + 0.25, 1e9 + 1, nan},
                                              {1e300, 2e300, 1.5e300},
                                              {-1.7e308, 1.7e308, 0},
                                              {1e-45, 3e-45, 2e-45},
                                              {1e-320, 3e-320, 2e-320},
                                              {1e200, 1e200}}) {
        const ScalarMap map = scalar_map_of(values);
        EXPECT_FALSE(is_identity(map)) << values[0];
        const double width = values[1] / 2 - values[0] / 2;
        for (const double value : values)
            if (!std::isnan(value)) {
                const auto stored = static_cast<float>(map.stored(value));
                EXPECT_LE(std::abs(stored), 1.0001f) << value;
                EXPECT_LE(std::abs(map.value(stored) / 2 - value / 2), std::max(1e-6 * std::abs(width), 5e-324))
                    << value;
            }
    }
}

} // namespace
} // namespace visorder::tests
