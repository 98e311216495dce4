#include "visorder/sorters.h"

#include "scenes/generated_scene.h"
#include "visorder/error.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <set>

namespace visorder::tests {

using namespace scenes;
namespace {

// Solids, or a surface for the sorters that take no solids.
Mesh mesh_for(const SorterInfo& info)
{
    return generate(std::string_view(info.name).starts_with("layers") ? "sphere:500" : "delaunay:500");
}

TEST(Registry, MakesEverySorterItLists)
{
    std::set<std::string> names;
    for (const SorterInfo& info : sorters()) {
        const Scene scene(mesh_for(info));
        EXPECT_TRUE(names.insert(info.name).second) << info.name << " twice";
        const auto sorter = make_sorter(info.name, scene);
        Order order;
        sorter->sort(look_at({3, 2, 1}, {0.5, 0.5, 0.5}, 1), order);
        EXPECT_EQ(order.back_to_front.size(), scene.cell_count()) << info.name;
        EXPECT_GT(sorter->bytes(), 0u) << info.name;
    }
    for (const char* name : {"centroid", "power", "newell", "mpvo", "mpvo-nc", "xmpvo", "xmpvo-exact", "bsp-xmpvo",
                             "xmpvo-layered", "layers", "layers-blocked", "layers-compute", "auto"})
        EXPECT_EQ(names.count(name), 1u) << name;
}

TEST(Registry, NamesTheSortersThereAreForAnUnknownOne)
{
    const Scene scene(generate("delaunay:500"));
    try {
        make_sorter("quicksort", scene);
        FAIL() << "no exception";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("quicksort"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("mpvo"), std::string::npos);
    }
}

TEST(Registry, EverySorterRefusesAnEyeThatIsNowhere)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    View view = look_at({3, 2, 1}, {0.5, 0.5, 0.5}, 1);
    for (const SorterInfo& info : sorters()) {
        const Scene scene(mesh_for(info));
        const auto sorter = make_sorter(info.name, scene);
        Order order;
        for (const glm::dvec4& eye : {glm::dvec4(0), glm::dvec4(nan, 0, 0, 1), glm::dvec4(1, 1, 1, nan),
                                      glm::dvec4(std::numeric_limits<double>::infinity(), 0, 0, 1)}) {
            view.eye = eye;
            EXPECT_THROW(sorter->sort(view, order), InputError) << info.name;
        }
    }
}

TEST(Registry, ASorterDerivesOnlyWhatItSaysItNeeds)
{
    for (const SorterInfo& info : sorters()) {
        if (std::string_view(info.name) == "auto")
            continue; // what it derives depends on the scene
        const Scene scene(mesh_for(info));
        const auto sorter = make_sorter(info.name, scene);
        Order order;
        sorter->sort(look_at({3, 2, 1}, {0.5, 0.5, 0.5}, 1), order);
        for (const StructureRecord& record : scene.derived())
            EXPECT_NE(std::find(info.structures.begin(), info.structures.end(), record.structure),
                      info.structures.end())
                << info.name << " derives " << name(record.structure);
        EXPECT_EQ(scene.derived().size(), info.structures.size()) << info.name;
    }
}

TEST(Auto, TakesWhatIsExactWhereSomethingIs)
{
    EXPECT_STREQ(choose_sorter(Scene(generate("delaunay:500"))).name, "mpvo");
    EXPECT_STREQ(choose_sorter(Scene(generate("grid:600"))).name, "mpvo");
    EXPECT_STREQ(choose_sorter(Scene(generate("carved:500"))).name, "bsp-xmpvo");
    EXPECT_STREQ(choose_sorter(Scene(generate("fin:600"))).name, "bsp-xmpvo");
    Mesh surface;
    surface.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    surface.add(CellShape::triangle, std::array{0u, 1u, 2u});
    EXPECT_STREQ(choose_sorter(Scene(surface)).name, "bsp-xmpvo");
}

TEST(VisibilityOrder, IsOneCall)
{
    const Mesh mesh = generate("delaunay:500");
    const Order order = visibility_order(mesh, look_at({3, 2, 1}, {0.5, 0.5, 0.5}, 1));
    EXPECT_EQ(order.back_to_front.size(), mesh.cell_count());
    EXPECT_TRUE(order.cycles.empty());
}

} // namespace
} // namespace visorder::tests
