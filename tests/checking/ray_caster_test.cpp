#include "naive_rays.h"
#include "small_scenes.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/ray_caster.h"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <glm/gtc/matrix_access.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <oneapi/tbb/global_control.h>
#include <string>
#include <vector>

namespace visorder::tests {
namespace {

const std::vector<MediumPoint> constant_medium{{0, 0.05, {0.2, 0.5, 0.9}}};
const std::vector<MediumPoint> medium_with_jumps{
    {5, 0.001, {1, 0, 0}}, {20, 0.05, {0, 1, 0}},      {20, 0.3, {0, 0, 1}},      {30, 0.2, {1, 1, 0}},
    {30, 0, {0, 0, 0}},    {40, 0.1, {0.3, 0.9, 0.5}}, {40, 0.02, {0.7, 0.1, 0}}, {60, 0.04, {0.1, 0.2, 1}}};

void add_scalars(Mesh& mesh, const std::function<float(const glm::dvec3&)>& scalar)
{
    mesh.scalars.clear();
    for (const glm::dvec3& p : mesh.points)
        mesh.scalars.push_back(scalar(p));
}

Mesh with_scalars(Mesh mesh)
{
    // Integers and their eighths, which single precision holds exactly.
    add_scalars(mesh, [](const glm::dvec3& p) { return static_cast<float>((2 * p.x + 3 * p.y - p.z) / 8); });
    return mesh;
}

Mesh with_wild_scalars(Mesh mesh, std::uint64_t seed)
{
    Random random(seed);
    add_scalars(mesh, [&](const glm::dvec3&) { return static_cast<float>(64 * random.real()); });
    return mesh;
}

Mesh tetrahedron(const std::array<glm::dvec3, 4>& corners)
{
    Mesh mesh;
    mesh.points.assign(corners.begin(), corners.end());
    mesh.add(CellShape::tetrahedron, std::array{0U, 1U, 2U, 3U});
    return mesh;
}

struct NamedEye {
    std::string name;
    View view;
};

// Views of a scene in [0, 64]^3: from outside and inside, at vertices, on faces and edges, along the axes and
// diagonals.
std::vector<NamedEye> views(const Scene& scene, glm::ivec2 size)
{
    const Mesh& mesh = scene.mesh();
    const glm::dvec3 middle(32);
    const auto corner = [&](std::size_t i) { return mesh.points[mesh.cell(scene.cell_count() / 2)[i]]; };
    const glm::dvec3 in_cell = (corner(0) + corner(1) + corner(2) + corner(3)) / 4.0;
    std::vector<NamedEye> result{
        {"outside", look_at({150, 80, 110}, middle, 56, 40, size)},
        {"close", look_at({66, 40, 31}, middle, 56, 90, size)},
        {"in a cell", look_at(in_cell, in_cell + glm::dvec3(3, 1, 2), 56, 80, size)},
        {"at a vertex", look_at(corner(0), corner(0) + glm::dvec3(-1, 2, 1), 56, 80, size)},
        {"on an edge", look_at((corner(0) + corner(1)) / 2.0, in_cell, 56, 80, size)},
        {"on a face, along it", look_at((corner(0) + 2.0 * corner(1) + corner(2)) / 4.0, corner(2), 56, 100, size)},
        {"amid, at an integer", look_at(middle, {40, 32, 32}, 56, 100, size)},
    };
    for (const glm::dvec3 direction : {glm::dvec3(1, 0, 0), {0, -1, 0}, {0, 0, 1}, {1, 1, 0}, {-1, 1, 1}, {3, -2, 7}})
        result.push_back({fmt::format("parallel ({}, {}, {})", direction.x, direction.y, direction.z),
                          parallel(direction, middle, 56, size)});
    return result;
}

template <class Check>
void each_pixel(const RayCast& cast, const Check& check)
{
    for (int y = 0; y < cast.size.y; ++y)
        for (int x = 0; x < cast.size.x; ++x) {
            SCOPED_TRACE(fmt::format("pixel {}, {}", x, y));
            check(x, y, cast.pixels[static_cast<std::size_t>(y * cast.size.x + x)]);
        }
}

void expect_near(const glm::dvec4& pixel, const Light& light, double tolerance)
{
    EXPECT_NEAR(pixel.a, 1 - light.transmittance, tolerance);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(pixel[k], light.colour[k], tolerance);
}

TEST(RayCaster, OneTetrahedronOfAConstantMediumHidesByItsChord)
{
    Random random(1);
    for (int i = 0; i < 20; ++i) {
        std::array<glm::dvec3, 4> corners;
        for (glm::dvec3& corner : corners)
            corner = random.integer_point(0, 64);
        const Scene scene(with_scalars(tetrahedron(corners)));
        for (const auto& [name, view] : views(scene, {12, 9})) {
            SCOPED_TRACE(fmt::format("tetrahedron {}, {}", i, name));
            each_pixel(cast_rays(scene, constant_medium, view), [&](int x, int y, const glm::dvec4& pixel) {
                const auto ray = naive::ray_through(view, x + 0.5, y + 0.5);
                const auto chord =
                    static_cast<double>(naive::inside_cell(ray, naive::corners(scene.mesh(), 0)).length());
                const double hidden = -std::expm1(-0.05 * chord);
                expect_near(pixel, {hidden * constant_medium[0].colour, 1 - hidden}, 1e-10);
            });
        }
    }
}

TEST(RayCaster, AConvexMeshOfAConstantMediumHidesByItsHullsChord)
{
    const Scene scene(with_scalars(carved_delaunay(50, 64, 1, 5)));
    for (const auto& [name, view] : views(scene, {33, 27})) {
        SCOPED_TRACE(name);
        each_pixel(cast_rays(scene, constant_medium, view), [&](int x, int y, const glm::dvec4& pixel) {
            const auto ray = naive::ray_through(view, x + 0.5, y + 0.5);
            const auto chord = static_cast<double>(naive::inside_hull(ray, scene).length());
            EXPECT_NEAR(pixel.a, -std::expm1(-0.05 * chord), 1e-10);
        });
    }
}

// Parallel rays along an axis, the centres of whose pixels are half units apart, from -1 on.
View along_axis(int axis, int pixels)
{
    glm::dmat4 world_to_clip(0);
    const double width = pixels * 0.5;
    for (int i = 0; i < 2; ++i) {
        world_to_clip[(axis + 1 + i) % 3][i] = 2 / width;
        world_to_clip[3][i] = -1 + 2 * 1.25 / width;
    }
    world_to_clip[axis][2] = -1e-2;
    world_to_clip[3][3] = 1;
    glm::dvec4 eye(0);
    eye[axis] = 1;
    return {eye, world_to_clip, {pixels, pixels}};
}

TEST(RayCaster, RaysAlongFacesAndEdgesPassEveryLengthOnce)
{
    const Scene scene(with_scalars(subdivide(whole_boxes({4, 4, 4}, 2, 0, 1)).mesh));
    ASSERT_EQ(scene.bounds().min, glm::dvec3(0));
    ASSERT_EQ(scene.bounds().max, glm::dvec3(8));
    const double whole = -std::expm1(-0.05 * 8);
    for (int axis = 0; axis < 3; ++axis)
        each_pixel(cast_rays(scene, constant_medium, along_axis(axis, 20)), [&](int x, int y, const glm::dvec4& pixel) {
            const double a = -1 + 0.5 * x, b = -1 + 0.5 * y;
            if (a < 0 || a > 8 || b < 0 || b > 8)
                EXPECT_EQ(pixel.a, 0);
            else if (a > 0 && a < 8 && b > 0 && b < 8)
                EXPECT_NEAR(pixel.a, whole, 1e-14);
            else
                EXPECT_NEAR(pixel.a, pixel.a > whole / 2 ? whole : 0, 1e-14); // along the surface: either
        });
}

TEST(RayCaster, EyesOnVerticesEdgesAndFacesOfAGridSeeEveryLengthOnce)
{
    const Scene scene(with_scalars(subdivide(whole_boxes({4, 4, 4}, 2, 0, 1)).mesh));
    for (const glm::dvec3 eye : {glm::dvec3(4, 4, 4), {4, 4, 3}, {4, 3, 3}, {3, 3, 3}, {3.5, 3.5, 4}})
        for (const glm::dvec3 to : {glm::dvec3(1, 0, 0), {0, 1, 0}, {0, 0, -1}, {1, 1, 0}, {1, 1, 1}, {1, -1, 1}}) {
            const View view = look_at(eye, eye + to, 5, 90, {31, 31});
            SCOPED_TRACE(fmt::format("from ({}, {}, {}) towards ({}, {}, {})", eye.x, eye.y, eye.z, to.x, to.y, to.z));
            each_pixel(cast_rays(scene, constant_medium, view), [&](int x, int y, const glm::dvec4& pixel) {
                const auto ray = naive::ray_through(view, x + 0.5, y + 0.5);
                const auto chord = static_cast<double>(naive::inside_hull(ray, scene).length());
                EXPECT_NEAR(pixel.a, -std::expm1(-0.05 * chord), 1e-12);
            });
        }
}

TEST(RayCaster, ALinearScalarOverAMeshIsTheIntegralAlongTheLine)
{
    const Scene scene(with_scalars(carved_delaunay(40, 64, 1, 7)));
    for (const auto& [name, view] : views(scene, {7, 5})) {
        SCOPED_TRACE(name);
        each_pixel(cast_rays(scene, medium_with_jumps, view), [&](int x, int y, const glm::dvec4& pixel) {
            const auto ray = naive::ray_through(view, x + 0.5, y + 0.5);
            const naive::Stretch stretch = naive::inside_hull(ray, scene);
            Light light;
            if (stretch.length() > 0)
                naive::pass_in_steps(light, stretch.length(), 100000, [&](double t) {
                    const glm::dvec3 p(ray.origin + (stretch.begin + t * stretch.length()) * ray.direction);
                    return naive::medium_at(medium_with_jumps, (2 * p.x + 3 * p.y - p.z) / 8);
                });
            expect_near(pixel, light, 3e-5); // a jump lies somewhere in its step
        });
    }
}

TEST(RayCaster, IsWhatTryingEveryCellFinds)
{
    std::vector<std::pair<std::string, Mesh>> meshes{{"carved Delaunay", carved_delaunay(40, 64, 0.5, 3)},
                                                     {"boxes", subdivide(box_grid({4, 4, 4}, 14, 0.4, 2)).mesh},
                                                     {"flat cells", flat_cells()},
                                                     {"thinly carved Delaunay", carved_delaunay(40, 64, 0.3, 9)}};
    for (auto& [mesh_name, mesh] : meshes) {
        const Scene scene(with_wild_scalars(std::move(mesh), 4));
        for (const auto& [name, view] : views(scene, {11, 8})) {
            SCOPED_TRACE(mesh_name + ", " + name);
            RayCastOptions options;
            options.silhouette_margin = 1e-6; // where rounding decides on which side of an outline a ray is
            const RayCast cast = cast_rays(scene, medium_with_jumps, view, options);
            each_pixel(cast, [&](int x, int y, const glm::dvec4& pixel) {
                if (cast.near_silhouette[static_cast<std::size_t>(y * cast.size.x + x)] == 0) {
                    const auto ray = naive::ray_through(view, x + 0.5, y + 0.5);
                    expect_near(pixel, naive::cast(scene, medium_with_jumps, ray, 2000), 3e-3);
                }
            });
        }
    }
}

TEST(RayCaster, FromFarAwayIsTheParallelView)
{
    const Scene scene(with_scalars(carved_delaunay(40, 64, 1, 7)));
    const glm::dvec3 direction = glm::normalize(glm::dvec3(3, -2, 7));
    const double distance = 64e9;
    const double angle = 2 * std::atan(56 / distance) * 180 / std::acos(-1.0);
    RayCastOptions options;
    options.silhouette_margin = 0.01;
    const RayCast far = cast_rays(scene, medium_with_jumps,
                                  look_at(glm::dvec3(32) + distance * direction, glm::dvec3(32), 56, angle), options);
    const RayCast flat = cast_rays(scene, medium_with_jumps, parallel(direction, glm::dvec3(32), 56), options);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < far.pixels.size(); ++i)
        if (far.near_silhouette[i] == 0 && flat.near_silhouette[i] == 0) {
            ++compared;
            for (int k = 0; k < 4; ++k)
                ASSERT_NEAR(far.pixels[i][k], flat.pixels[i][k], 1e-5) << "pixel " << i;
        }
    EXPECT_GT(compared, far.pixels.size() / 2);
}

TEST(RayCaster, SeesTheSameFarFromTheOrigin)
{
    const Mesh mesh = with_scalars(carved_delaunay(40, 64, 0.5, 3));
    Mesh moved = mesh;
    const glm::dvec3 offset(1 << 24, -(1 << 25), 3 << 22);
    for (glm::dvec3& p : moved.points)
        p += offset; // exactly: coordinates are small integers
    const Scene near(mesh), far(moved);
    const glm::dvec3 eye(150, 80, 110), target(32);
    RayCastOptions options;
    options.silhouette_margin = 0.01;
    const auto expect_same = [&](const View& of_near, const View& of_far, double tolerance) {
        const RayCast a = cast_rays(near, medium_with_jumps, of_near, options);
        const RayCast b = cast_rays(far, medium_with_jumps, of_far, options);
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            for (int k = 0; k < 4 && a.near_silhouette[i] == 0; ++k)
                ASSERT_NEAR(a.pixels[i][k], b.pixels[i][k], tolerance) << "pixel " << i;
    };
    expect_same(look_at(eye, target, 56, 40, {60, 50}), look_at(eye + offset, target + offset, 56, 40, {60, 50}), 1e-9);
    // A parallel view has nothing but its matrix, which is rounded at the distance of the origin.
    expect_same(parallel(eye, target, 56, {60, 50}), parallel(eye, target + offset, 56, {60, 50}), 1e-6);
}

TEST(RayCaster, ClipsAtTheNearAndFarPlanesOnlyIfAsked)
{
    Mesh box;
    add_box(box, {0, 0, 0}, {10, 10, 10});
    const Scene scene(with_scalars(subdivide(box).mesh));
    Camera camera;
    camera.position = {5, 5, 20};
    camera.focal_point = {5, 5, 0};
    camera.near = 13; // at z = 7
    camera.far = 18;  // at z = 2
    for (const bool is_parallel : {false, true}) {
        camera.parallel = is_parallel;
        camera.parallel_scale = 4;
        camera.view_angle = 15;
        const View view = view_of(camera, {21, 21});
        RayCastOptions options;
        const auto hidden = [&](const RayCast& cast) { return -std::log1p(-cast.pixels[10 * 21 + 10].a) / 0.05; };
        EXPECT_NEAR(hidden(cast_rays(scene, constant_medium, view, options)), 10, 1e-12);
        options.clip_near_and_far = true;
        const RayCast clipped = cast_rays(scene, constant_medium, view, options);
        EXPECT_NEAR(hidden(clipped), 5, 1e-12);
        const auto corner = naive::ray_through(view, 0.5, 0.5);
        EXPECT_NEAR(-std::log1p(-clipped.pixels[0].a) / 0.05, 5 / -static_cast<double>(corner.direction.z), 1e-12);
    }
}

TEST(RayCaster, PassesOverlappingCellsEachWholeAndNoFlatOnes)
{
    Mesh mesh = tetrahedron({{{0, 0, 0}, {64, 0, 0}, {0, 64, 0}, {0, 0, 64}}});
    const Scene once(with_scalars(mesh));
    mesh.add(CellShape::tetrahedron, std::array{0U, 1U, 3U, 2U}); // the other way round
    mesh.add(CellShape::tetrahedron, std::array{0U, 1U, 3U, 3U});
    mesh.points.emplace_back(32, 32, 0);
    mesh.add(CellShape::tetrahedron, std::array{0U, 1U, 2U, 4U});
    const Scene twice(with_scalars(mesh));
    const View view = look_at({80, 70, 90}, {16, 16, 16}, 40, 40, {32, 32});
    const RayCast one = cast_rays(once, medium_with_jumps, view);
    const RayCast two = cast_rays(twice, medium_with_jumps, view);
    for (std::size_t i = 0; i < one.pixels.size(); ++i)
        EXPECT_NEAR(1 - two.pixels[i].a, std::pow(1 - one.pixels[i].a, 2), 1e-12) << "pixel " << i;
}

TEST(RayCaster, IsTheSameOnAnyNumberOfThreads)
{
    const Scene scene(with_wild_scalars(carved_delaunay(40, 64, 0.6, 3), 8));
    const View view = look_at({70, 60, 90}, glm::dvec3(32), 56, 50, {100, 70});
    const RayCast all = cast_rays(scene, medium_with_jumps, view);
    const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(cast_rays(scene, medium_with_jumps, view).pixels, all.pixels);
}

TEST(RayCaster, MarksPixelsAtOutlinesAndNoOthers)
{
    Mesh box;
    add_box(box, {10, 12, 14}, {50, 52, 54});
    const Scene scene(with_scalars(subdivide(box).mesh));
    for (const View& view : {look_at({150, 80, 110}, glm::dvec3(32), 56, 40, {80, 60}),
                             parallel({3, 5, -4}, glm::dvec3(32), 56, {60, 80})}) {
        RayCastOptions options;
        options.silhouette_margin = 1;
        const RayCast cast = cast_rays(scene, constant_medium, view, options);
        const auto index = [&](int x, int y) { return static_cast<std::size_t>(y * cast.size.x + x); };
        const auto inside = [&](int x, int y) { return cast.pixels[index(x, y)].a > 0; };
        for (int y = 3; y < cast.size.y - 3; ++y)
            for (int x = 3; x < cast.size.x - 3; ++x) {
                SCOPED_TRACE(fmt::format("pixel {}, {}", x, y));
                if (inside(x, y) != inside(x + 1, y) || inside(x, y) != inside(x, y + 1)) {
                    EXPECT_EQ(cast.near_silhouette[index(x, y)], 1);
                }
                if (cast.near_silhouette[index(x, y)] == 1) {
                    int same = 0;
                    for (int dy = -2; dy <= 2; ++dy)
                        for (int dx = -2; dx <= 2; ++dx)
                            same += inside(x, y) == inside(x + dx, y + dy) ? 1 : 0;
                    EXPECT_LT(same, 25);
                }
            }
    }
}

TEST(RayCaster, MarksOutlinesThatPassBehindTheEye)
{
    // A box that the eye is on the inside of, but for its front: the outline is that of nothing, as all faces turn
    // away.
    Mesh box;
    add_box(box, {0, 0, 0}, {64, 64, 64});
    const Scene scene(with_scalars(subdivide(box).mesh));
    RayCastOptions options;
    options.silhouette_margin = 2;
    const RayCast inside = cast_rays(scene, constant_medium, look_at({32, 32, 32}, {64, 40, 32}, 56, 90), options);
    EXPECT_EQ(std::count(inside.near_silhouette.begin(), inside.near_silhouette.end(), 1), 0);
    // From just outside a face, its own outline is what is seen, all around the eye, partly behind it.
    const RayCast outside = cast_rays(scene, constant_medium, look_at({65, 32, 32}, {64.5, 32, 64}, 56, 90), options);
    const auto column = [&](int x, int y) {
        return outside.near_silhouette[static_cast<std::size_t>(y * outside.size.x + x)] == 1;
    };
    int marked = 0;
    for (int y = 0; y < outside.size.y; ++y)
        for (int x = 1; x < outside.size.x; ++x) {
            const auto alpha = [&](int at) { return outside.pixels[static_cast<std::size_t>(y * 512 + at)].a; };
            if ((alpha(x) > 0) != (alpha(x - 1) > 0)) {
                EXPECT_TRUE(column(x, y) && column(x - 1, y)) << x << ", " << y;
                ++marked;
            }
        }
    EXPECT_GT(marked, 100);
}

std::string fault(const std::function<void()>& cast)
{
    try {
        cast();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(RayCaster, RefusesWhatItCannotCast)
{
    const View view = look_at({80, 70, 90}, {16, 16, 16}, 40, 40, {8, 8});
    const auto with = [&](const Mesh& mesh) {
        const Scene scene(mesh);
        return fault([&] { cast_rays(scene, constant_medium, view); });
    };
    Mesh box;
    add_box(box, {0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(with(with_scalars(box)), "cell 0: not a tetrahedron; subdivide the mesh first");
    Mesh mesh = tetrahedron({{{0, 0, 0}, {64, 0, 0}, {0, 64, 0}, {0, 0, 64}}});
    EXPECT_EQ(with(mesh), "the mesh has no scalars to colour it by");
    mesh = with_scalars(mesh);
    EXPECT_EQ(with(mesh), "");
    mesh.scalars[2] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(with(mesh), "point 2: scalar nan is not finite");

    const Scene scene(with_scalars(mesh));
    const auto from = [&](const View& bad) { return fault([&] { cast_rays(scene, constant_medium, bad); }); };
    EXPECT_NE(from({{0, 0, 0, 0}, view.world_to_clip, view.size}), "");
    EXPECT_NE(from({view.eye, view.world_to_clip, {0, 8}}), "");
    EXPECT_NE(from({view.eye, glm::dmat4(0), view.size}), "");
    EXPECT_NE(from({view.eye, glm::dmat4(std::nan("")), view.size}), "");
    EXPECT_NE(from({{0, 0, 1, 0}, view.world_to_clip, view.size}), "");
    glm::dmat4 flat = view.world_to_clip;
    flat = glm::row(flat, 0, glm::row(flat, 1));
    EXPECT_NE(from({view.eye, flat, view.size}), "");
    EXPECT_NE(fault([&] { cast_rays(scene, {}, view); }), "");
}

} // namespace
} // namespace visorder::tests
