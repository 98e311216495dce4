#include "sorting/topological_sort.h"

#include "scene/adjacency.h"
#include "scene/face_planes.h"
#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <random>
#include <set>

namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

// All relations that the sort is given, in the caller's numbering.
std::vector<Relation> all_relations(const Scene& scene, const FaceSigns& signs, const std::vector<Relation>& more)
{
    std::vector<Relation> relations;
    const auto caller = scene.caller_cells();
    for (CellId cell = 0; cell < scene.cell_count(); ++cell)
        for (std::size_t face = 0; face < scene.adjacency().row(cell).size(); ++face)
            if ((scene.adjacency().interior[cell] & signs.exit(cell)) >> face & 1)
                relations.push_back({caller[cell], caller[scene.adjacency().row(cell)[face]]});
    for (const Relation& r : more)
        relations.push_back({caller[r.front], caller[r.back]});
    return relations;
}

// The strongly connected sets of more than one cell, by reachability from every cell.
std::vector<std::vector<CellId>> cycles_by_reachability(CellId cells, const std::vector<Relation>& relations)
{
    std::vector<std::vector<CellId>> next(cells);
    for (const Relation& r : relations)
        next[r.front].push_back(r.back);
    std::vector<std::vector<bool>> reaches(cells, std::vector<bool>(cells, false));
    for (CellId start = 0; start < cells; ++start) {
        std::vector<CellId> open{start};
        while (!open.empty()) {
            const CellId cell = open.back();
            open.pop_back();
            for (CellId n : next[cell])
                if (!reaches[start][n]) {
                    reaches[start][n] = true;
                    open.push_back(n);
                }
        }
    }
    std::vector<std::vector<CellId>> cycles;
    std::vector<bool> done(cells, false);
    for (CellId a = 0; a < cells; ++a) {
        if (done[a] || !reaches[a][a])
            continue;
        std::vector<CellId> cycle;
        for (CellId b = a; b < cells; ++b)
            if (b == a || (reaches[a][b] && reaches[b][a])) {
                cycle.push_back(b);
                done[b] = true;
            }
        if (cycle.size() > 1)
            cycles.push_back(cycle);
    }
    return cycles;
}

void expect_order(const Scene& scene, const Order& order, const std::vector<Relation>& relations,
                  const std::vector<std::vector<CellId>>& cycles)
{
    const CellId cells = scene.cell_count();
    std::vector<CellId> sorted = order.back_to_front;
    std::sort(sorted.begin(), sorted.end());
    std::vector<CellId> all(cells);
    std::iota(all.begin(), all.end(), 0u);
    ASSERT_EQ(sorted, all) << "not every cell once";
    EXPECT_EQ(order.cycles, cycles);

    std::vector<std::size_t> position(cells), layer(cells), cycle(cells, 0);
    for (std::size_t i = 0; i < order.back_to_front.size(); ++i)
        position[order.back_to_front[i]] = i;
    for (std::size_t l = 0; l < order.layer_begin.size(); ++l) {
        const std::size_t end = l + 1 < order.layer_begin.size() ? order.layer_begin[l + 1] : cells;
        ASSERT_LT(order.layer_begin[l], end) << "an empty layer";
        for (std::size_t i = order.layer_begin[l]; i < end; ++i)
            layer[order.back_to_front[i]] = l;
    }
    for (std::size_t c = 0; c < cycles.size(); ++c)
        for (CellId cell : cycles[c])
            cycle[cell] = c + 1;
    for (const Relation& r : relations) {
        EXPECT_NE(layer[r.front], layer[r.back]) << r.front << " obstructs " << r.back << " in one layer";
        if (cycle[r.front] == 0 || cycle[r.front] != cycle[r.back]) {
            EXPECT_LT(position[r.back], position[r.front]) << r.front << " obstructs " << r.back;
        }
    }
}

TEST(TopologicalSort, SatisfiesInteriorAndRandomFurtherRelationsOrReportsTheCycles)
{
    std::mt19937_64 random(11);
    for (const char* specification : {"delaunay:300", "carved:200", "pinwheel", "contact:300"})
        for (bool whole_grid : {false, true}) {
            const Mesh mesh = whole_grid ? generate("grid:600") : generate(specification);
            const Scene scene(mesh);
            for (const NamedView& view : random_views(scene, 6, 5, {8, 8}))
                for (std::size_t count : {0u, 5u, 60u}) {
                    SCOPED_TRACE(testing::Message() << specification << (whole_grid ? " grid " : " ") << view.name
                                                    << " and " << count << " relations");
                    FaceSigns signs;
                    signs.evaluate(scene, view.view.eye);
                    std::vector<Relation> more;
                    while (more.size() < count) {
                        const auto a = static_cast<CellId>(random() % scene.cell_count());
                        const auto b = static_cast<CellId>(random() % scene.cell_count());
                        if (a != b)
                            more.push_back({a, b});
                    }
                    TopologicalSort sort;
                    Order order;
                    sort.run(scene, signs, more, order);
                    const auto relations = all_relations(scene, signs, more);
                    ASSERT_NO_FATAL_FAILURE(
                        expect_order(scene, order, relations, cycles_by_reachability(scene.cell_count(), relations)));
                }
        }
}

TEST(TopologicalSort, GivesTheSameOrderForAnyNumberOfThreadsAndFromRunToRun)
{
    std::mt19937_64 random(13);
    for (const char* specification : {"delaunay:150000", "carved:60000", "grid:60000", "pinwheel:60000"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        TopologicalSort sort;
        for (const NamedView& view : random_views(scene, 2, 1, {8, 8}))
            for (std::size_t count : {0u, 2000u}) {
                SCOPED_TRACE(testing::Message() << specification << " " << view.name << ", " << count << " relations");
                FaceSigns signs;
                signs.evaluate(scene, view.view.eye);
                std::vector<Relation> more;
                while (more.size() < count) {
                    const auto a = static_cast<CellId>(random() % scene.cell_count());
                    more.push_back({a, (a + 1 + static_cast<CellId>(random() % 9)) % scene.cell_count()});
                }
                Order expected;
                {
                    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
                    sort.run(scene, signs, more, expected);
                }
                for (int threads : {2, 2, 3, 4}) {
                    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                                            static_cast<std::size_t>(threads));
                    oneapi::tbb::task_arena arena(threads);
                    Order order;
                    arena.execute([&] { sort.run(scene, signs, more, order); });
                    ASSERT_EQ(order.back_to_front, expected.back_to_front) << threads << " threads";
                    ASSERT_EQ(order.layer_begin, expected.layer_begin) << threads << " threads";
                    ASSERT_EQ(order.cycles, expected.cycles) << threads << " threads";
                }
            }
    }
}

TEST(TopologicalSort, ListsDisconnectedCellsInOneLayer)
{
    Mesh mesh;
    for (std::uint32_t i = 0; i < 50'000; ++i) {
        const double x = i;
        const std::uint32_t first = 4 * i;
        for (const glm::dvec3& p :
             {glm::dvec3(x, 0, 0), glm::dvec3(x + 0.5, 0, 0), glm::dvec3(x, 1, 0), glm::dvec3(x, 0, 1)})
            mesh.points.push_back(p);
        mesh.add(CellShape::tetrahedron, std::array{first, first + 1, first + 2, first + 3});
    }
    const Scene scene(mesh);
    FaceSigns signs;
    signs.evaluate(scene, {0, 0, 9, 1});
    TopologicalSort sort;
    Order order;
    sort.run(scene, signs, {}, order);
    EXPECT_EQ(order.layer_begin, std::vector<std::uint32_t>{0});
    EXPECT_EQ(order.back_to_front.size(), 50'000u);
}

} // namespace
} // namespace visorder::tests
