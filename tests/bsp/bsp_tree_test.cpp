#include "bsp/bsp_tree.h"

#include "geometry/exact_predicates.h"
#include "geometry/face_overlap.h"
#include "scene/adjacency.h"
#include "scene/face_loop.h"
#include "tests/checking/expectations.h"
#include "tests/checking/generated.h"
#include "tests/checking/small_scenes.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;

using namespace scenes;
namespace {

bool has_area(const std::vector<glm::dvec3>& points)
{
    for (std::size_t i = 2; i < points.size(); ++i)
        if (!collinear(points[0], points[i - 1], points[i]) || !collinear(points[i - 2], points[i - 1], points[i]))
            return true;
    return false;
}

using Walk = std::vector<std::vector<std::uint32_t>>;

Walk walk(const BspTree& tree, const glm::dvec4& eye)
{
    Walk groups;
    tree.walk(eye, [&](std::span<const std::uint32_t> group) { groups.emplace_back(group.begin(), group.end()); });
    return groups;
}

// Where the walk comes to each face first and last.
struct Places {
    std::vector<std::size_t> first, last;

    Places(const BspTree& tree, const glm::dvec4& eye)
        : first(tree.faces().size(), std::size_t(-1)), last(tree.faces().size(), 0)
    {
        std::size_t place = 0;
        tree.walk(eye, [&](std::span<const std::uint32_t> group) {
            ++place;
            for (std::uint32_t face : group) {
                first[face] = std::min(first[face], place);
                last[face] = place;
            }
        });
    }

    bool may_cover(std::size_t nearer, std::size_t farther) const { return first[farther] <= last[nearer]; }
};

const char* const many_faces[] = {"carved:3000", "contact:1500", "cavity:2000", "reactor:1500",
                                  "slivers:600", "shells:1500",  "cards:300",   "knot:900"};

TEST(BspTree, HasEveryFaceThatHasArea)
{
    const auto expect_all_faces = [](const Mesh& mesh, const std::string& name) {
        const Scene scene(mesh);
        const BspTree tree(scene, 1);
        ASSERT_EQ(tree.faces().size(), scene.is_surface() ? scene.cell_count() : scene.relation_faces().size());
        ASSERT_EQ(tree.group_counts().size(), tree.faces().size());
        std::size_t groups = 0, placed = 0;
        for (std::size_t i = 0; i < tree.faces().size(); ++i) {
            EXPECT_EQ(tree.group_counts()[i] > 0, has_area(points_of(scene, tree.faces()[i])))
                << name << ", face " << tree.faces()[i].face << " of inner cell " << tree.faces()[i].cell;
            groups += tree.group_counts()[i];
            placed += tree.group_counts()[i] > 0;
        }
        EXPECT_EQ(tree.split_count(), groups - placed) << name;
    };
    for (const char* specification : many_faces)
        expect_all_faces(subdivide(generate(specification)).mesh, specification);
    for (std::uint64_t number = 1; number <= 200; ++number)
        expect_all_faces(small_scene(number), fmt::format("small scene {}", number));
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        expect_all_faces(squashed_delaunay(seed), fmt::format("squashed mesh {}", seed));
        expect_all_faces(random_triangles(50, 9, seed), fmt::format("random triangles {}", seed));
    }
    expect_all_faces(flat_cells(), "flat cells");
    // Nothing but triangles without area: no group, and no node.
    const Scene scene(triangles({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}, {5, 5, 5}, {6, 7, 8}}));
    const BspTree tree(scene, 1);
    EXPECT_EQ(tree.node_count(), 0u);
    EXPECT_TRUE(walk(tree, {1, 2, 3, 1}).empty());
}

TEST(BspTree, WalksThroughEveryGroupOnceFromAnyEye)
{
    for (const char* specification : many_faces) {
        const Scene scene(subdivide(generate(specification)).mesh);
        const BspTree tree(scene, 1);
        for (const NamedView& view : all_views(scene)) {
            SCOPED_TRACE(std::string(specification) + ", " + view.name);
            std::vector<std::uint32_t> groups_of(tree.faces().size(), 0);
            std::set<const std::uint32_t*> begins;
            std::size_t visits = 0, not_empty = 0;
            tree.walk(view.view.eye, [&](std::span<const std::uint32_t> group) {
                ++visits;
                not_empty += !group.empty();
                if (!group.empty())
                    begins.insert(group.data());
                for (std::uint32_t face : group)
                    ++groups_of[face];
            });
            EXPECT_EQ(visits, tree.node_count());
            EXPECT_EQ(begins.size(), not_empty);
            EXPECT_TRUE(std::equal(groups_of.begin(), groups_of.end(), tree.group_counts().begin()));
        }
    }
}

// Parallel triangles that no plane splits: the walk from one side is that from the other, backwards.
TEST(BspTree, WalksTheFarSideFirst)
{
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 400; ++i)
        corners.insert(corners.end(), {{0, 0, 2 * i}, {9, 0, 2 * i}, {0, 9, 2 * i}});
    const Scene scene(triangles(corners));
    const BspTree tree(scene, 1);
    EXPECT_EQ(tree.split_count(), 0u);
    EXPECT_GT(tree.node_count(), 20u);
    const auto height = [&](std::uint32_t face) {
        return scene.mesh().points[scene.mesh().cell(tree.faces()[face].cell)[0]].z;
    };
    for (const double at : {-10.0, 51.0, 73.0, 400.0, 2000.0}) {
        const Places places(tree, {2, 2, at, 1});
        for (std::uint32_t f = 0; f < tree.faces().size(); ++f)
            for (std::uint32_t g = 0; g < tree.faces().size(); ++g)
                if ((height(f) - at) * (height(g) - at) > 0 && std::abs(height(f) - at) < std::abs(height(g) - at)) {
                    EXPECT_LE(places.last[g], places.first[f]) << "eye at " << at;
                }
    }
    for (const double weight : {0.0, 1.0}) {
        Walk from_above = walk(tree, {0, 0, 2000, weight});
        const Walk from_below = walk(tree, {0, 0, -2000, weight});
        std::reverse(from_above.begin(), from_above.end());
        EXPECT_EQ(from_above, from_below);
        EXPECT_NE(from_above.front(), from_below.back());
    }
}

// Every pair of faces of which one covers the other, exactly.
TEST(BspTree, ComesToTheFartherFaceOfEveryPairFirst)
{
    const auto expect_order = [](const Scene& scene, const std::string& name, const std::vector<glm::dvec4>& eyes) {
        for (const std::uint64_t seed : {1u, 2u}) {
            const BspTree tree(scene, seed);
            for (const glm::dvec4& eye : eyes) {
                SCOPED_TRACE(reproduce(fmt::format("{}, tree of seed {}", name, seed), eye));
                const Places places(tree, eye);
                std::vector<SeenFace> seen;
                for (const CellFace& face : tree.faces())
                    seen.push_back(seen_face(points_of(scene, face), eye));
                for (std::size_t f = 0; f < seen.size(); ++f)
                    for (std::size_t g = 0; g < seen.size(); ++g) {
                        if (f == g || seen[f].turn == Sign::zero || seen[g].turn == Sign::zero ||
                            places.may_cover(f, g))
                            continue;
                        const Overlap overlap = face_overlap(seen[f], seen[g], eye);
                        EXPECT_TRUE(overlap != Overlap::nearer && overlap != Overlap::coincident &&
                                    overlap != Overlap::crossing)
                            << "faces " << f << " and " << g;
                    }
            }
        }
    };
    for (std::uint64_t number = 1; number <= 200 && !HasFailure(); ++number) {
        const Scene scene(small_scene(number));
        expect_order(scene, fmt::format("small scene {}", number), some_of(small_scene_eyes(scene, number), number, 5));
    }
    for (std::uint64_t seed = 1; seed <= 20 && !HasFailure(); ++seed) {
        const Scene squashed(squashed_delaunay(seed)), triangles(random_triangles(60, 12, seed)),
            overlapping(overlapping_cells(20, 14, seed));
        expect_order(squashed, fmt::format("squashed mesh {}", seed), some_of(small_scene_eyes(squashed, seed), 0, 5));
        expect_order(triangles, fmt::format("triangles {}", seed), some_of(small_scene_eyes(triangles, seed), 1, 5));
    }
    for (const char* specification : {"contact:600", "reactor:600", "carved:600", "slivers:600", "cards:300"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        std::vector<glm::dvec4> eyes;
        for (const NamedView& view : hard_views(scene, {64, 64}))
            eyes.push_back(view.view.eye);
        expect_order(scene, specification, some_of(eyes, 0, 3));
    }
}

// Where the ray from `at` along `along` meets the inside of the face, clearly: how far, in lengths of `along`.
std::optional<double> clear_hit(const std::vector<glm::dvec3>& face, const glm::dvec3& at, const glm::dvec3& along)
{
    const glm::dvec3 n = glm::cross(face[1] - face[0], face[2] - face[0]);
    const double falls = glm::dot(n, along);
    if (std::abs(falls) < 1e-6 * glm::length(n) * glm::length(along))
        return {};
    const double distance = glm::dot(n, face[0] - at) / falls;
    const glm::dvec3 hit = at + distance * along;
    for (std::size_t i = 0; i < face.size(); ++i) {
        const glm::dvec3 edge = face[(i + 1) % face.size()] - face[i];
        if (glm::dot(glm::cross(edge, hit - face[i]), n) <
            1e-6 * glm::length(edge) * glm::length(edge) * glm::length(n))
            return {};
    }
    return distance;
}

// Along random rays: splits lose no face, also in trees that are many planes deep.
TEST(BspTree, ComesToWhatIsFartherOnARayFirst)
{
    std::size_t compared = 0, deepest = 0;
    for (const char* specification :
         {"carved:20000", "reactor:8000", "cavity:6000", "shells:5000", "gear-helical:2000"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        const BspTree tree(scene, 1);
        deepest = std::max(deepest, tree.depth());
        std::vector<std::vector<glm::dvec3>> faces;
        for (const CellFace& face : tree.faces())
            faces.push_back(points_of(scene, face));
        Random random(11);
        const glm::dvec3 size = scene.bounds().max - scene.bounds().min;
        const auto inside = [&] {
            const double x = random.real(), y = random.real(), z = random.real();
            return scene.bounds().min + glm::dvec3(x, y, z) * size;
        };
        for (int i = 0; i < 12; ++i) {
            const bool parallel = i % 3 == 0;
            // Far away, or within the bounds.
            const glm::dvec3 place =
                i % 3 == 1 ? scene.bounds().middle() + 3.0 * (inside() - scene.bounds().middle()) : inside();
            const glm::dvec3 direction = inside() - scene.bounds().middle();
            const glm::dvec4 eye = parallel ? glm::dvec4(direction, 0) : glm::dvec4(place, 1);
            const Places places(tree, eye);
            for (int ray = 0; ray < 12; ++ray) {
                const glm::dvec3 along = parallel ? -direction : inside() - place;
                const glm::dvec3 at = parallel ? inside() - 100.0 * along : place;
                std::vector<std::pair<double, std::size_t>> hits;
                for (std::size_t face = 0; face < faces.size(); ++face)
                    if (const auto distance = clear_hit(faces[face], at, along); distance && *distance > 1e-9)
                        hits.emplace_back(*distance, face);
                std::sort(hits.begin(), hits.end());
                for (std::size_t near = 0; near < hits.size(); ++near)
                    for (std::size_t far = near + 1; far < hits.size(); ++far) {
                        if (hits[far].first - hits[near].first < 1e-9 * hits[far].first)
                            continue;
                        ++compared;
                        EXPECT_TRUE(places.may_cover(hits[near].second, hits[far].second))
                            << reproduce(specification, eye) << ", ray along " << along.x << ", " << along.y << ", "
                            << along.z << ", faces " << hits[near].second << " and " << hits[far].second;
                    }
            }
        }
    }
    EXPECT_GT(compared, 3000u);
    EXPECT_GT(deepest, 10u);
}

TEST(BspTree, HasFewNodesAndSplits)
{
    const Scene scene(generate("carved:50000"));
    const BspTree tree(scene, 1);
    EXPECT_LE(tree.node_count(), 6 * tree.faces().size());
    EXPECT_LE(tree.split_count(), 10 * tree.faces().size());
    EXPECT_LE(tree.depth(), 100u);
    EXPECT_GT(tree.bytes(), tree.node_count() * 4 * sizeof(std::uint32_t));
}

TEST(BspTree, IsTheSameForAnyNumberOfThreads)
{
    for (const char* specification : {"carved:8000", "reactor:3000", "shells:3000"}) {
        const Scene scene(subdivide(generate(specification)).mesh);
        const BspTree expected(scene, 1);
        for (int threads = 1; threads <= 4; ++threads) {
            const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(threads));
            oneapi::tbb::task_arena arena(threads);
            arena.execute([&] {
                const BspTree tree(scene, 1);
                EXPECT_EQ(tree.node_count(), expected.node_count());
                EXPECT_EQ(tree.depth(), expected.depth());
                EXPECT_EQ(tree.split_count(), expected.split_count());
                for (const NamedView& view : random_views(scene, 3, 5, {64, 64}))
                    EXPECT_EQ(walk(tree, view.view.eye), walk(expected, view.view.eye))
                        << specification << ", " << view.name << ", " << threads << " threads";
            });
        }
    }
}

TEST(BspTree, DiffersBySeed)
{
    const Scene scene(generate("carved:1500"));
    EXPECT_NE(walk(BspTree(scene, 1), {1, 2, 3, 0}), walk(BspTree(scene, 2), {1, 2, 3, 0}));
}

} // namespace
} // namespace visorder::tests
