// Pictures of surfaces against rays that are met with every triangle in doubles.

#include "projection/opengl/surface_renderer.h"

#include "graphics/context.h"
#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "visorder/error.h"
#include "visorder/sorters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;

using namespace scenes;

namespace {

constexpr double tolerance = 1e-5;

const Context& context()
{
    static const Context only;
    return only;
}

struct Hit {
    double distance;
    CellId cell; // the caller's
    double scalar;

    bool operator==(const Hit& other) const { return cell == other.cell; }
};

// All triangles of a scene that the ray through a point of the image passes through, the nearest first.
class Rays {
public:
    Rays(const Scene& scene, const View& view)
        : scene_(scene), view_(view), from_clip_(glm::inverse(view.world_to_clip)), touching_(1e-9 * scene.diameter())
    {
    }

    // Pixels. With `touches`, also those that the eye lies in, as far as doubles can tell: whether they are seen from
    // there is anyone's guess.
    std::vector<Hit> hits(double x, double y, bool touches = false) const
    {
        const glm::dvec2 at = 2.0 * glm::dvec2(x, y) / glm::dvec2(view_.size) - 1.0;
        const glm::dvec3 middle = unprojected({at, 0}), far = unprojected({at, 0.5});
        const bool perspective = view_.eye.w != 0;
        const glm::dvec3 from = perspective ? glm::dvec3(view_.eye) : middle;
        const glm::dvec3 along = glm::normalize(perspective ? far - from : -glm::dvec3(view_.eye));
        std::vector<Hit> result;
        for (CellId cell = 0; cell < scene_.cell_count(); ++cell)
            if (const std::optional<Hit> hit = met(cell, from, along);
                hit && (!perspective || hit->distance > touching_ || (touches && hit->distance > -touching_)))
                result.push_back(*hit);
        std::sort(result.begin(), result.end(), [](const Hit& a, const Hit& b) { return a.distance < b.distance; });
        return result;
    }

    // Whether a hair's breadth decides what is hit there.
    bool near_an_edge(double x, double y, const std::vector<Hit>& hits_there) const
    {
        for (const double step : {-1e-3, 1e-3})
            if (hits(x + step, y) != hits_there || hits(x, y + step) != hits_there)
                return true;
        return false;
    }

private:
    glm::dvec3 unprojected(const glm::dvec3& clip) const
    {
        const glm::dvec4 world = from_clip_ * glm::dvec4(clip, 1);
        return glm::dvec3(world) / world.w;
    }

    // Möller, Trumbore 1997.
    std::optional<Hit> met(CellId cell, const glm::dvec3& from, const glm::dvec3& along) const
    {
        const Mesh& mesh = scene_.mesh();
        const auto v = mesh.cell(cell);
        const glm::dvec3 a = mesh.points[v[0]];
        const glm::dvec3 ab = mesh.points[v[1]] - a, ac = mesh.points[v[2]] - a;
        const glm::dvec3 p = glm::cross(along, ac);
        const double determinant = glm::dot(ab, p);
        if (determinant == 0)
            return std::nullopt;
        const glm::dvec3 offset = from - a;
        const double b = glm::dot(offset, p) / determinant;
        const glm::dvec3 q = glm::cross(offset, ab);
        const double c = glm::dot(along, q) / determinant;
        if (!(b >= 0 && c >= 0 && b + c <= 1))
            return std::nullopt;
        const auto scalar = [&](std::size_t i) {
            return mesh.scalars.empty() ? 0.0 : static_cast<double>(mesh.scalars[v[i]]);
        };
        return Hit{glm::dot(ac, q) / determinant, scene_.caller_cells()[cell],
                   (1 - b - c) * scalar(0) + b * scalar(1) + c * scalar(2)};
    }

    const Scene& scene_;
    const View& view_;
    glm::dmat4 from_clip_;
    double touching_;
};

glm::dvec4 composited(const std::vector<Hit>& hits, const SurfaceOptions& options)
{
    glm::dvec4 result(0);
    for (auto hit = hits.rbegin(); hit != hits.rend(); ++hit) {
        const glm::dvec3 colour = options.function ? options.function->at(hit->scalar).colour : options.colour;
        result = glm::dvec4(colour, 1) * options.opacity + (1 - options.opacity) * result;
    }
    return result;
}

// Puts hits of one depth as the order has them: any order of them is right.
void settle_ties(std::vector<Hit>& hits, const Order& order)
{
    std::vector<std::size_t> rank(order.back_to_front.size());
    for (std::size_t i = 0; i < rank.size(); ++i)
        rank[order.back_to_front[i]] = i;
    for (std::size_t begin = 0; begin < hits.size();) {
        std::size_t end = begin + 1;
        while (end < hits.size() &&
               hits[end].distance - hits[end - 1].distance <= 1e-9 * std::abs(hits[end].distance) + 1e-12)
            ++end;
        std::sort(hits.begin() + static_cast<std::ptrdiff_t>(begin), hits.begin() + static_cast<std::ptrdiff_t>(end),
                  [&](const Hit& a, const Hit& b) { return rank[a.cell] > rank[b.cell]; });
        begin = end;
    }
}

Order order_for(const Scene& scene, const View& view)
{
    Order order;
    make_sorter("auto", scene)->sort(view, order);
    return order;
}

// Holds a picture against rays, away from edges; returns how many pixels show something.
std::size_t expect_right(const Scene& scene, const View& view, const SurfaceOptions& options)
{
    const Order order = order_for(scene, view);
    const Image image = SurfaceRenderer(context(), scene, options).draw(view, order);
    const Rays rays(scene, view);
    std::size_t compared = 0, shown = 0;
    double worst = 0;
    std::string where;
    for (int y = 0; y < view.size.y; ++y)
        for (int x = 0; x < view.size.x; ++x) {
            std::vector<Hit> hits = rays.hits(x + 0.5, y + 0.5);
            if (rays.near_an_edge(x + 0.5, y + 0.5, hits))
                continue;
            settle_ties(hits, order);
            ++compared;
            shown += hits.empty() ? 0 : 1;
            const auto error_of = [&](const std::vector<Hit>& met) {
                const glm::dvec4 error =
                    glm::abs(glm::dvec4(image.pixels[image.index(x, y)]) - composited(met, options));
                return std::max({error.x, error.y, error.z, error.w});
            };
            double most = error_of(hits);
            if (const std::vector<Hit> more = rays.hits(x + 0.5, y + 0.5, true); more.size() == hits.size() + 1)
                most = std::min(most, error_of(more));
            if (!(most <= worst)) {
                worst = most;
                where = "pixel " + std::to_string(x) + ", " + std::to_string(y) + " with " +
                        std::to_string(hits.size()) + " triangles";
            }
        }
    EXPECT_LE(worst, tolerance) << where;
    EXPECT_GT(compared, image.pixels.size() / 4);
    return shown;
}

TransferFunction colours_for(const Scene& scene)
{
    return named_transfer_function("rainbow", scene, 1);
}

// Both ways of blending, in one colour and by scalars.
std::vector<SurfaceOptions> looks(const Scene& scene)
{
    SurfaceOptions flat, thin, coloured, apart;
    flat.opacity = 0.37;
    flat.colour = {0.9, 0.5, 0.1};
    flat.channels_apart = false;
    thin.opacity = 0.01;
    coloured.opacity = 0.6;
    coloured.function = colours_for(scene);
    coloured.channels_apart = false;
    apart = coloured;
    apart.channels_apart = true;
    return {flat, thin, coloured, apart};
}

Mesh triangles(std::vector<glm::dvec3> points, const std::vector<std::array<PointId, 3>>& cells)
{
    Mesh mesh;
    mesh.points = std::move(points);
    for (const auto& cell : cells)
        mesh.add(CellShape::triangle, cell);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        mesh.scalars.push_back(static_cast<float>(i % 5));
    return mesh;
}

Mesh with_scalars(Mesh mesh)
{
    mesh.scalars.clear();
    for (const glm::dvec3& p : mesh.points)
        mesh.scalars.push_back(static_cast<float>(p.x + 2 * p.y - p.z));
    return mesh;
}

TEST(SurfaceRenderer, ShowsWhatRaysMeetFromEveryHardView)
{
    for (const char* specification : {"sphere:80", "knot:300", "shells:300"}) {
        const Scene scene(with_scalars(generate(specification)));
        std::vector<NamedView> views = hard_views(scene, {33, 24});
        for (NamedView& view : random_views(scene, 4, 7, {40, 31}))
            views.push_back(std::move(view));
        const std::vector<SurfaceOptions> all = looks(scene);
        for (std::size_t i = 0; i < views.size(); ++i) {
            SCOPED_TRACE(std::string(specification) + " seen from " + views[i].name);
            expect_right(scene, views[i].view, all[i % all.size()]);
        }
    }
}

TEST(SurfaceRenderer, ShowsTrianglesThatReachBehindTheEye)
{
    // A floor and a ceiling around the eye, a wall behind it, and a triangle before it.
    const Scene scene(triangles({{-9, -1, -9},
                                 {9, -1, -9},
                                 {9, -1, 9},
                                 {-9, -1, 9},
                                 {-9, 1, -9},
                                 {9, 1, -9},
                                 {0, 1, 9},
                                 {-9, -9, 10},
                                 {9, -9, 10},
                                 {0, 9, 10},
                                 {-1, -0.5, -2},
                                 {1, -0.5, -2},
                                 {0, 0.9, -3}},
                                {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}}));
    for (const double angle : {20.0, 90.0, 150.0})
        for (const glm::dvec3& target : {glm::dvec3(0, 0, -1), glm::dvec3(0.3, -0.9, -0.1), glm::dvec3(1, 0.2, 1)})
            for (const SurfaceOptions& options : looks(scene)) {
                SCOPED_TRACE(std::to_string(angle) + " degrees towards " + std::to_string(target.x));
                EXPECT_GT(expect_right(scene, look_at({0, 0, 0}, target, 10, angle, {48, 36}), options), 0U);
            }
}

TEST(SurfaceRenderer, ShowsCoplanarTrianglesInAnyOrder)
{
    // Two that overlap, two equal ones, and one turned over, in one plane; and one before them.
    const Scene scene(
        triangles({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {5, 1, 0}, {1, 5, 0}, {2, 2, 1}, {6, 2, 1}, {2, 6, 1}},
                  {{0, 1, 2}, {3, 4, 5}, {3, 4, 5}, {0, 2, 1}, {6, 7, 8}}));
    for (const NamedView& view : random_views(scene, 6, 3, {40, 40})) {
        SCOPED_TRACE(view.name);
        for (const SurfaceOptions& options : looks(scene))
            EXPECT_GT(expect_right(scene, view.view, options), 0U);
    }
}

TEST(SurfaceRenderer, DrawsEveryTriangleOfACycle)
{
    // Three bars, each over the next one.
    std::vector<glm::dvec3> points;
    std::vector<std::array<PointId, 3>> cells;
    for (int bar = 0; bar < 3; ++bar) {
        const double turn = 2 * 3.14159265358979 * bar / 3;
        const glm::dvec3 along(std::cos(turn), std::sin(turn), 0), across(-along.y, along.x, 0);
        const auto first = static_cast<PointId>(points.size());
        points.push_back(-3.0 * along + 0.6 * across + glm::dvec3(0, 0, -0.5));
        points.push_back(3.0 * along + 0.6 * across + glm::dvec3(0, 0, 0.5));
        points.push_back(3.0 * along + 1.2 * across + glm::dvec3(0, 0, 0.5));
        cells.push_back({first, first + 1, first + 2});
    }
    const Scene scene(triangles(points, cells));
    const View view = parallel({0, 0, 1}, {0, 0, 0}, 4, {60, 60});
    EXPECT_EQ(order_for(scene, view).cycles.size(), 1U);
    SurfaceOptions options;
    options.opacity = 0.3;
    EXPECT_GT(expect_right(scene, view, options), 0U); // in one colour, no order shows
}

TEST(SurfaceRenderer, MeetsAClosedConvexSurfaceTwiceInEveryPixel)
{
    const Scene scene(generate("sphere:2000"));
    SurfaceOptions options;
    options.opacity = 0.5;
    SurfaceRenderer renderer(context(), scene, options);
    for (const NamedView& view : random_views(scene, 8, 5, {200, 150})) {
        SCOPED_TRACE(view.name);
        const Image image = renderer.draw(view.view, order_for(scene, view.view));
        std::size_t shown = 0;
        for (const glm::vec4& pixel : image.pixels)
            if (pixel.w != 0) {
                ++shown;
                ASSERT_EQ(pixel.w, 0.75f); // not even along silhouettes
            }
        EXPECT_GT(shown, 1000U);
    }
}

TEST(SurfaceRenderer, MeetsOneOfTheTrianglesAroundACornerInAPixelsCentre)
{
    // A grid of which every corner lies at a pixel's centre; squares are cut along either diagonal.
    constexpr PointId side = 17;
    Mesh mesh;
    for (PointId y = 0; y < side; ++y)
        for (PointId x = 0; x < side; ++x)
            mesh.points.emplace_back(x + 0.5, y + 0.5, 0);
    for (PointId y = 0; y + 1 < side; ++y)
        for (PointId x = 0; x + 1 < side; ++x) {
            const PointId a = y * side + x, b = a + 1, c = a + side, d = c + 1;
            const bool other = (x * 7 + y * 3) % 4 < 2;
            mesh.add(CellShape::triangle, std::array<PointId, 3>{a, b, other ? c : d});
            mesh.add(CellShape::triangle, other ? std::array<PointId, 3>{d, b, c} : std::array<PointId, 3>{a, c, d});
        }
    const Scene scene(std::move(mesh));
    View view{glm::dvec4(0, 0, 1, 0), glm::dmat4(1), {32, 32}};
    view.world_to_clip[0][0] = view.world_to_clip[1][1] = 1.0 / 16;
    view.world_to_clip[3] = glm::dvec4(-1, -1, 0, 1);
    SurfaceOptions options;
    options.opacity = 0.5;
    const Image image = SurfaceRenderer(context(), scene, options).draw(view, order_for(scene, view));
    // To the left and below, the border belongs to the grid; to the right and above, it does not.
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            EXPECT_EQ(image.pixels[image.index(x, y)].w, x < 16 && y < 16 ? 0.5f : 0.0f) << x << ", " << y;
}

TEST(SurfaceRenderer, TakesTheColourOfAStepAtItsVeryScalar)
{
    Mesh mesh = triangles({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
    mesh.scalars = {0.3f, 0.3f, 0.3f};
    const Scene scene(std::move(mesh));
    const double at = static_cast<double>(0.3f);
    SurfaceOptions options;
    options.opacity = 1;
    options.function.emplace(std::vector<OpticalPoint>{{at - 1, 0, {1, 0, 0}}, {at, 0, {1, 0, 0}}, {at, 0, {0, 1, 0}}});
    const View view = look_at({1, 1, 9}, {1, 1, 0}, 3, 30, {64, 64});
    const Image image = SurfaceRenderer(context(), scene, options).draw(view, order_for(scene, view));
    std::size_t shown = 0;
    for (const glm::vec4& pixel : image.pixels)
        if (pixel.w != 0) {
            ++shown;
            ASSERT_EQ(pixel, glm::vec4(0, 1, 0, 1));
        }
    EXPECT_GT(shown, 100U);
}

TEST(SurfaceRenderer, RefusesWhatItCannotDraw)
{
    const Scene volume(generate("delaunay:100"));
    const Scene surface(generate("sphere:20"));
    EXPECT_THROW(SurfaceRenderer(context(), volume), InputError);
    SurfaceOptions options;
    options.opacity = 1.5;
    EXPECT_THROW(SurfaceRenderer(context(), surface, options), InputError);
    options = {};
    options.colour.g = -1;
    EXPECT_THROW(SurfaceRenderer(context(), surface, options), InputError);
    options = {};
    options.blending_bits = 7;
    EXPECT_THROW(SurfaceRenderer(context(), surface, options), InputError);
    SurfaceRenderer renderer(context(), surface);
    const View view = look_at({3, 2, 1}, {0, 0, 0}, 1);
    EXPECT_THROW(renderer.draw(view, {}), InputError);
    Order wrong = order_for(surface, view);
    wrong.back_to_front[3] = 1000;
    EXPECT_THROW(renderer.draw(view, wrong), InputError);
}

} // namespace
} // namespace visorder::tests
