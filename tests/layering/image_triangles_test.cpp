#include "layering/image_triangles.h"

#include "bench/layer_truth.h"
#include "scene/boundary.h"
#include "scenes/generated_scene.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <set>
#include <tuple>

namespace visorder::tests {

using namespace detail;

using namespace bench;
using namespace scenes;
namespace {

ImageTriangles projected(const ItemMesh& items, const Scene& scene, const View& view, glm::ivec2 size)
{
    ImageTriangles result;
    const std::vector<std::uint8_t> all(items.item_count(), 1);
    project(items, all, scene.mesh().points, view.world_to_clip, size, result);
    return result;
}

bool inside(const ImageTriangle& triangle, const glm::dvec2& pixel)
{
    const glm::dvec3 p(pixel - glm::dvec2(triangle.origin), 1);
    return glm::dot(triangle.edges[0], p) > 0 && glm::dot(triangle.edges[1], p) > 0 &&
           glm::dot(triangle.edges[2], p) > 0;
}

std::vector<View> some_views(glm::ivec2 size)
{
    return {look_at({2, 3, 4}, {0, 0, 0}, 1, 30, size), look_at({0.3, 0.1, 0.2}, {1, 1, -1}, 1, 70, size),
            parallel({1, -2, 0.5}, {0, 0, 0}, 1, size)};
}

TEST(ImageTriangles, AreInsideWhereTheTruthIs)
{
    constexpr glm::ivec2 size(90, 70);
    const Mesh mesh = generate("shells:300");
    const Scene scene(mesh);
    const ItemMesh items = surface_items(scene);
    for (const View& view : some_views(size)) {
        std::set<std::tuple<std::uint32_t, CellId>> expected, found;
        for (const TrueFragment& fragment : true_fragments(mesh, view, size))
            expected.insert({fragment.pixel, fragment.triangle});
        for (const ImageTriangle& triangle : projected(items, scene, view, size).triangles)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x)
                    if (inside(triangle, glm::dvec2(x, y) + 0.5))
                        found.insert({static_cast<std::uint32_t>(y * size.x + x), triangle.item});
        EXPECT_EQ(found, expected);
        EXPECT_GT(expected.size(), 1000u);
    }
}

TEST(ImageTriangles, HaveDepthsThatFallAlongEachRay)
{
    constexpr glm::ivec2 size(60, 60);
    const Mesh mesh = generate("shells:300");
    const Scene scene(mesh);
    const ItemMesh items = surface_items(scene);
    for (const View& view : some_views(size)) {
        const ImageTriangles triangles = projected(items, scene, view, size);
        const std::vector<TrueFragment> fragments = true_fragments(mesh, view, size);
        const auto depth = [&](const TrueFragment& fragment) {
            const ImageTriangle& triangle = triangles.triangles[triangles.begin[fragment.triangle]];
            const glm::dvec2 pixel(fragment.pixel % 60 + 0.5, fragment.pixel / 60 + 0.5);
            return glm::dot(triangle.depth, glm::dvec3(pixel - glm::dvec2(triangle.origin), 1));
        };
        for (std::size_t i = 0; i < fragments.size(); ++i) {
            EXPECT_GE(depth(fragments[i]), 0);
            EXPECT_LE(depth(fragments[i]), 1);
            if (i > 0 && fragments[i].pixel == fragments[i - 1].pixel &&
                fragments[i].distance - fragments[i - 1].distance > tie_distance(mesh)) {
                EXPECT_LT(depth(fragments[i]), depth(fragments[i - 1]));
            }
        }
    }
}

// OpenGL moves corners to a grid of 1/256 pixel.
TEST(ImageTriangles, AreDrawnLargerThanTheyAre)
{
    constexpr glm::ivec2 size(400, 300);
    const Scene scene(generate("knot:600"));
    const View view = look_at({2, 3, 9}, {0, 0, 0}, 4, 30, size);
    const ItemMesh items = surface_items(scene);
    for (const ImageTriangle& triangle : projected(items, scene, view, size).triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec4& corner = triangle.corners[i];
            const glm::dvec2 pixel =
                (glm::dvec2(corner) / static_cast<double>(corner.w) + 1.0) / 2.0 * glm::dvec2(size);
            const glm::dvec3 p(pixel - glm::dvec2(triangle.origin), 1);
            for (std::size_t k = 0; k < 3; ++k)
                if (k != i) { // the two sides that meet at the corner
                    EXPECT_NEAR(glm::dot(triangle.edges[k], p) / glm::length(glm::dvec2(triangle.edges[k])), -1.0 / 256,
                                1e-4);
                }
        }
}

TEST(ImageTriangles, LeaveOutWhatCoversNoSamplePointAndWhatIsNotWanted)
{
    const Scene scene(generate("sphere:5000"));
    const ItemMesh items = surface_items(scene);
    constexpr glm::ivec2 size(20, 20);
    const View view = look_at({2, 3, 4}, {0, 0, 0}, 1, 30, size);
    const ImageTriangles all = projected(items, scene, view, size);
    EXPECT_LT(all.triangles.size(), 800u);
    EXPECT_EQ(all.begin.size(), scene.cell_count() + 1u);
    std::vector<std::uint8_t> wanted(scene.cell_count());
    for (std::size_t i = 0; i < wanted.size(); ++i)
        wanted[i] = i % 2;
    ImageTriangles some;
    project(items, wanted, scene.mesh().points, view.world_to_clip, size, some);
    EXPECT_FALSE(some.triangles.empty());
    for (const ImageTriangle& triangle : some.triangles)
        EXPECT_EQ(triangle.item % 2, 1u);
}

TEST(ItemMesh, OfABoundaryHasOneOrTwoTrianglesAFace)
{
    const Scene tetrahedra(subdivide(generate("carved:600")).mesh), hexahedra(generate("reactor:600"));
    for (const Scene* scene : {&tetrahedra, &hexahedra}) {
        const ItemMesh items = boundary_items(*scene);
        ASSERT_EQ(items.item_count(), scene->boundary().faces.size());
        for (std::uint32_t item = 0; item < items.item_count(); ++item)
            EXPECT_EQ(items.begin[item + 1] - items.begin[item], scene == &tetrahedra ? 1u : 2u);
        EXPECT_EQ(items.triangles.size(), items.begin.back());
    }
}

} // namespace
} // namespace visorder::tests
