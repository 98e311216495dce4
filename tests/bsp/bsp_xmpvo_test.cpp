#include "bsp/bsp_xmpvo.h"

#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "tests/checking/expectations.h"
#include "tests/checking/generated.h"
#include "tests/checking/small_scenes.h"
#include "visorder/checking.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

// What all exact sorters have in common is tested in exact_sorters_test.cpp.
namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

TEST(BspXmpvo, IsRightWithAnySeed)
{
    for (const char* specification : {"carved:1500", "contact:600", "reactor:600", "cards:200", "pinwheel:60"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        const OrderChecker checker(scene);
        for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{2}, std::uint64_t{3}, ~std::uint64_t{0}}) {
            BspXmpvo sorter(scene, seed);
            for (const NamedView& view : random_views(scene, 3, 6, {64, 64})) {
                SCOPED_TRACE(fmt::format("{}, {}, tree of seed {}", specification, view.name, seed));
                expect_right_order(checker, sorter, view.view.eye);
            }
        }
    }
    for (std::uint64_t seed = 1; seed <= 100 && !HasFailure(); ++seed) {
        const Scene scene(small_scene(seed));
        const OrderChecker checker(scene);
        BspXmpvo sorter(scene, 1000 + seed);
        for (const glm::dvec4& eye : some_of(small_scene_eyes(scene, seed), seed, 5)) {
            SCOPED_TRACE(reproduce(fmt::format("small scene {}, tree of seed {}", seed, 1000 + seed), eye));
            expect_right_order(checker, sorter, eye);
        }
    }
}

TEST(BspXmpvo, NumbersItsBoundaryCells)
{
    const Scene scene(generate("carved:1500"));
    const std::vector<CellFace>& faces = scene.boundary().faces;
    const BoundaryCells cells(faces, scene.cell_count());
    std::size_t covered = 0;
    for (std::size_t i = 0; i < cells.count(); ++i) {
        const auto [begin, end] = cells.faces(i);
        EXPECT_EQ(begin, covered);
        ASSERT_LT(begin, end);
        for (std::uint32_t face = begin; face < end; ++face) {
            EXPECT_EQ(cells.of_face(face), i);
            EXPECT_EQ(cells.of_cell(faces[face].cell), i);
        }
        covered = end;
    }
    EXPECT_EQ(covered, faces.size());
}

TEST(BspXmpvo, CountsWhatItDoes)
{
    const Scene scene(generate("carved:1500"));
    BspXmpvo sorter(scene, 1);
    const BspTree tree(scene, 1);
    double relations = 0;
    for (const NamedView& view : random_views(scene, 4, 6, {64, 64})) {
        sorted(sorter, view.view.eye);
        EXPECT_EQ(statistic(sorter, "nodes"), static_cast<double>(tree.node_count()));
        EXPECT_EQ(statistic(sorter, "splits"), static_cast<double>(tree.split_count()));
        EXPECT_EQ(statistic(sorter, "depth"), static_cast<double>(tree.depth()));
        EXPECT_GE(statistic(sorter, "pair tests"), statistic(sorter, "exact tests"));
        EXPECT_GE(statistic(sorter, "pair tests"), statistic(sorter, "relations"));
        relations += statistic(sorter, "relations");
    }
    EXPECT_GT(relations, 0);
    EXPECT_GT(sorter.bytes(), tree.bytes());
}

} // namespace
} // namespace visorder::tests
