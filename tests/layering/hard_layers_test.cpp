// The cases in which layers go wrong first.

#include "layers_of.h"
#include "scenes/generated_scene.h"
#include "tests/checking/small_scenes.h"
#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace visorder::tests {

using namespace bench;

using namespace scenes;
namespace {

std::vector<std::uint32_t> ascending_from(std::uint32_t first, std::size_t count)
{
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), first);
    return numbers;
}

TEST(HardLayers, OfTrianglesInOnePlaneTheLowerNumberIsNearer)
{
    // In x + 2y + 3z = 12, exactly.
    const std::vector<glm::dvec3> one{{12, 0, 0}, {0, 6, 0}, {0, 0, 4}};
    const std::vector<glm::dvec3> other{{9, 0, 1}, {1, 4, 1}, {-1, -1, 5}};
    const std::vector<glm::dvec3> third{{4, 4, 0}, {0, 3, 2}, {6, 0, 2}};
    std::vector<std::vector<glm::dvec3>> sets{one, other, third};
    std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a[0].x < b[0].x; });
    for (int permutation = 0; permutation < 6; ++permutation) {
        std::vector<glm::dvec3> corners;
        for (const auto& set : sets)
            corners.insert(corners.end(), set.begin(), set.end());
        const Mesh mesh = triangles(corners);
        for (const View& view : {look_at({20, 25, 17}, {3, 2, 2}, 9), parallel({0.3, 1, 0.7}, {3, 2, 2}, 9)})
            for (const Extraction& extraction : every_variant) {
                SCOPED_TRACE(words(extraction));
                const Layers layers = layers_of(mesh, view, {200, 200}, extraction);
                EXPECT_EQ(layers.layer, ascending_from(1, 3));
                EXPECT_TRUE(layers.unproven.empty());
            }
        std::next_permutation(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a[0].x < b[0].x; });
    }
}

TEST(HardLayers, OfOneTriangleManyTimesTheLowerNumberIsNearer)
{
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 40; ++i)
        corners.insert(corners.end(), {{0.1, 0.2, 0.3}, {1.7, 0.4, -0.6}, {0.3, 1.9, 0.5}});
    const Layers layers = layers_of(triangles(corners), look_at({3, 4, 5}, {0.7, 0.8, 0}, 2), {64, 64});
    EXPECT_EQ(layers.layer, ascending_from(1, 40));
}

TEST(HardLayers, TakesNeedlesThinnerThanAPixel)
{
    Random random(4);
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 1500; ++i) {
        const glm::dvec3 at(random.real(), random.real(), random.real());
        const glm::dvec3 along(random.real() - 0.5, random.real() - 0.5, random.real() - 0.5);
        const glm::dvec3 across(random.real() - 0.5, random.real() - 0.5, random.real() - 0.5);
        const double width = std::pow(10, -1 - 5 * random.real()); // of a pixel: 10 to 1e-4
        corners.insert(corners.end(), {at, at + along, at + along * 0.9 + width * across});
    }
    const Mesh mesh = triangles(corners);
    constexpr glm::ivec2 size(150, 150);
    for (const View& view : {look_at({3, 2, 4}, {0.5, 0.5, 0.5}, 1), parallel({1, 0.2, 0.4}, {0.5, 0.5, 0.5}, 1)}) {
        const Layers layers = layers_of(mesh, view, size);
        const LayerCheck check = expect_true(mesh, view, size, layers);
        EXPECT_GT(check.pairs, 100u);
        EXPECT_GT(count_of(layers, WithoutProof::no_sample), 20u);
        expect_same(layers_of(mesh, view, size, {LayerVariant::compute}), layers);
    }
}

TEST(HardLayers, CutsTrianglesAtThePlaneOfTheEye)
{
    // A floor of two triangles under and behind the eye, spheres around it, and one before it.
    Mesh mesh = generate("shells:400");
    const auto first = static_cast<PointId>(mesh.points.size());
    for (const glm::dvec3& point : {glm::dvec3(-30, -0.3, -40), {40, -0.3, -30}, {30, -0.3, 40}, {-40, -0.3, 30}})
        mesh.points.push_back(point);
    mesh.add(CellShape::triangle, std::array{first, first + 1, first + 2});
    mesh.add(CellShape::triangle, std::array{first, first + 2, first + 3});
    mesh.scalars.clear();
    constexpr glm::ivec2 size(160, 120);
    for (const glm::dvec3& eye : {glm::dvec3(0, 0, 0), {0.05, 0.02, 0.5}, {0.9, 0.1, -0.3}, {0.1, -0.29, 3}})
        for (const double angle : {40.0, 110.0}) {
            SCOPED_TRACE(testing::Message() << "eye " << eye.x << "," << eye.y << "," << eye.z << ", " << angle);
            const View view = look_at(eye, eye + glm::dvec3(0.3, -0.2, -1), 1, angle, size);
            const Layers layers = layers_of(mesh, view, size);
            const LayerCheck check = expect_true(mesh, view, size, layers);
            EXPECT_GT(check.pairs, 1000u);
            expect_same(layers_of(mesh, view, size, {LayerVariant::compute}), layers);
            expect_same(layers_of(mesh, view, size, {LayerVariant::naive}), layers);
        }
}

TEST(HardLayers, TakesWhatTheClippingPlanesOfTheViewWouldCutOff)
{
    const Mesh mesh = generate("shells:300");
    View view = look_at({3, 2, 1}, {0, 0, 0}, 1);
    const Layers layers = layers_of(mesh, view, {100, 100});
    Camera camera;
    camera.position = {3, 2, 1};
    camera.near = 3.7;
    camera.far = 3.8;
    view = view_of(camera, {100, 100});
    const View fitted = [&] {
        camera.near = 1;
        camera.far = 10;
        return view_of(camera, {100, 100});
    }();
    EXPECT_EQ(layers.count, 10u);
    expect_same(layers_of(mesh, view, {100, 100}), layers_of(mesh, fitted, {100, 100}));
    expect_true(mesh, view, {100, 100}, layers_of(mesh, view, {100, 100}));
}

TEST(HardLayers, TakesFiveThousandTrianglesApartThatCoverOnePixel)
{
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < 5000; ++i) {
        const double z = (i * 1237) % 5000;
        corners.insert(corners.end(), {{-1, -1, z}, {3, -1, z}, {-1, 3, z}});
    }
    const Layers layers = layers_of(triangles(corners), parallel({0, 0, 1}, {0, 0, 2500}, 1), {1, 1});
    EXPECT_EQ(layers.count, 5000u);
    for (std::uint32_t i = 0; i < 5000; ++i)
        EXPECT_EQ(layers.layer[i], 5000 - (i * 1237) % 5000);
}

TEST(HardLayers, TakesMoreCandidatesAtOnePixelThanTheStencilBufferCounts)
{
    // Blades that all cover the middle; most are seen at their tips.
    constexpr int blades = 320;
    std::vector<glm::dvec3> corners;
    for (int i = 0; i < blades; ++i) {
        const double angle = 2 * std::numbers::pi * i / blades;
        const glm::dvec3 along(std::cos(angle), std::sin(angle), 0), across(-along.y, along.x, 0);
        const glm::dvec3 at(0, 0, 0.001 * ((i * 147) % blades));
        corners.insert(corners.end(), {at - 0.1 * (along + across), at - 0.1 * (along - across), at + along});
    }
    const Mesh mesh = triangles(corners);
    constexpr glm::ivec2 size(256, 256);
    const View view = parallel({0, 0, 1}, {0, 0, 0.2}, 1);
    const Scene scene(mesh);
    LayersSorter sorter(scene, LayerVariant::naive, GlPlatform::automatic, size, 64);
    Order order;
    sorter.sort(view, order);
    const Layers& expected = sorter.layers();
    EXPECT_GT(expect_true(mesh, view, size, expected).pairs, 100'000u);
    EXPECT_EQ(expected.count, static_cast<std::uint32_t>(blades));
    EXPECT_GT(sorter.work().flags_read, 0u) << "the stencil buffer was never full";
    for (const LayerVariant variant : {LayerVariant::blocked, LayerVariant::compute})
        expect_same(layers_of(mesh, view, size, {variant}), expected);
}

TEST(HardLayers, ReportsWhyATriangleHasNoProof)
{
    const Mesh mesh = triangles({{0, 0, 0},
                                 {1, 0, 0},
                                 {0, 1, 0}, // seen
                                 {0, 0, 1},
                                 {1, 0, 1},
                                 {0, 0, 2}, // edge-on
                                 {0.501, 0.5, 1},
                                 {0.502, 0.5, 1},
                                 {0.5, 0.501, 1}, // between sample points
                                 {9, 9, 0},
                                 {10, 9, 0},
                                 {9, 10, 0}, // beside the image
                                 {0, 0, 0},
                                 {0, 0, 0},
                                 {1, 1, 0}}); // no area
    const Layers layers = layers_of(mesh, parallel({0, 0, 1}, {0.5, 0.5, 1}, 0.7), {10, 10});
    EXPECT_EQ(layers.layer, (std::vector<std::uint32_t>{1, 0, 0, 0, 0}));
    ASSERT_EQ(layers.unproven.size(), 4u);
    EXPECT_EQ(layers.unproven[0].reason, WithoutProof::edge_on);
    EXPECT_EQ(layers.unproven[1].reason, WithoutProof::no_sample);
    EXPECT_EQ(layers.unproven[2].reason, WithoutProof::no_sample);
    EXPECT_EQ(layers.unproven[3].reason, WithoutProof::edge_on);
}

TEST(HardLayers, TakesAnEmptyImage)
{
    const Mesh mesh = generate("sphere:100");
    for (const View& view : {look_at({5, 0, 0}, {9, 0, 0}, 1), look_at({5, 0, 0}, {5, 9, 0}, 1)})
        for (const Extraction& extraction : every_variant) {
            const Layers layers = layers_of(mesh, view, {64, 64}, extraction);
            EXPECT_EQ(layers.count, 0u);
            EXPECT_EQ(count_of(layers, WithoutProof::no_sample), mesh.cell_count());
        }
}

TEST(HardLayers, TakesImagesOfAnySize)
{
    const Mesh mesh = generate("shells:400");
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 300}, {333, 7}, {63, 65}, {200, 40}}) {
        SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
        const View view = look_at({3, 2, 4}, {0.01, 0.02, 0}, 1, 30, size);
        const Layers layers = layers_of(mesh, view, size);
        EXPECT_EQ(layers.count, 10u);
        expect_true(mesh, view, size, layers);
        for (const Extraction& extraction : every_variant)
            expect_same(layers_of(mesh, view, size, extraction), layers);
    }
    EXPECT_THROW(layers_of(mesh, look_at({3, 2, 4}, {0, 0, 0}, 1), {1 << 20, 4}), InputError);
    EXPECT_THROW(layers_of(mesh, look_at({3, 2, 4}, {0, 0, 0}, 1), {4, -4}), InputError);
    EXPECT_THROW(layers_of(mesh, look_at({3, 2, 4}, {0, 0, 0}, 1), {4, 4}, {LayerVariant::blocked, {}, 0}), InputError);
}

TEST(HardLayers, TakesAnImageOfSixteenMillionPixels)
{
    const Mesh mesh = generate("sphere:80");
    const View view = look_at({3, 2, 4}, {0, 0, 0}, 4);
    const Layers layers = layers_of(mesh, view, {4096, 4096});
    EXPECT_EQ(layers.count, 2u);
    EXPECT_TRUE(layers.unproven.empty());
    expect_same(layers_of(mesh, view, {4096, 4096}, {LayerVariant::compute}), layers);
}

} // namespace
} // namespace visorder::tests
