#include "visorder/error.h"
#include "visorder/view.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace visorder::tests {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

glm::dvec3 projected(const View& view, const glm::dvec3& point)
{
    const glm::dvec4 clip = view.world_to_clip * glm::dvec4(point, 1);
    return glm::dvec3(clip) / clip.w;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance)
{
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

std::vector<glm::dvec3> points_on_sphere(const glm::dvec3& centre, double radius)
{
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 500; ++i)
        points.push_back(centre + radius * glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
    return points;
}

/// Directions along the axes, along diagonals and askew.
std::vector<glm::dvec3> directions()
{
    return {{1, 0, 0},  {0, 1, 0}, {0, 0, 1},    {-1, 0, 0},    {0, -1, 0},
            {0, 0, -1}, {1, 1, 1}, {0, 1, 1e-3}, {0, 1, 1e-12}, {0.3, -0.2, 0.9}};
}

/// What is wrong with a view; empty if nothing.
std::string fault(const std::function<void()>& make)
{
    try {
        make();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(View, PerspectiveCameraPlacesWhatVtkPlaces)
{
    Camera camera;
    camera.position = {3, 4, 5};
    camera.focal_point = {3, 4, -5};
    camera.up = {0, 2, 0.5}; // not square to the view, not a unit vector
    camera.view_angle = 90;
    camera.near = 2;
    camera.far = 8;
    const View view = view_of(camera, {200, 100});

    EXPECT_EQ(view.eye, glm::dvec4(3, 4, 5, 1));
    EXPECT_EQ(view.size, glm::ivec2(200, 100));
    expect_near(projected(view, {3, 4, 3}), {0, 0, -1}, 1e-14);
    expect_near(projected(view, {3, 4, -3}), {0, 0, 1}, 1e-14);
    // At distance 2 the view is 4 high, and 8 wide.
    expect_near(projected(view, {3 + 4, 4 + 2, 3}), {1, 1, -1}, 1e-14);
    expect_near(projected(view, {3 - 4, 4 - 2, 3}), {-1, -1, -1}, 1e-14);
}

TEST(View, ParallelCameraPlacesWhatVtkPlaces)
{
    Camera camera;
    camera.position = {1.1, 0.2, 0.3};
    camera.focal_point = {0.1, 0.2, 0.3};
    camera.up = {0, 0, 1};
    camera.parallel = true;
    camera.parallel_scale = 3;
    camera.near = -1;
    camera.far = 4;
    const View view = view_of(camera, {100, 200});

    EXPECT_EQ(view.eye, glm::dvec4(1.1 - 0.1, 0, 0, 0)) << "the difference as it is, not of unit length";
    expect_near(projected(view, {2.1, 0.2, 0.3}), {0, 0, -1}, 1e-14);
    expect_near(projected(view, {-2.9, 0.2, 0.3}), {0, 0, 1}, 1e-14);
    // Looking along -x with z up, y points to the right.
    expect_near(projected(view, {1.1, 0.2 + 1.5, 0.3 + 3}), {1, 1, -0.6}, 1e-14);
}

TEST(View, LookAtHoldsTheSphereInDepthFromNearAndFar)
{
    const glm::dvec3 target(10, -20, 30);
    for (const double radius : {1e-6, 1.0, 1e6})
        for (const double distance : {1e-12, 0.5, 1.0, 3.0, 1e9, 1e30})
            for (const glm::dvec3& direction : directions()) {
                const glm::dvec3 position = target + radius * distance * glm::normalize(direction);
                if (position == target)
                    continue;
                SCOPED_TRACE(testing::Message() << "radius " << radius << " distance " << distance << " direction "
                                                << direction.x << ' ' << direction.y << ' ' << direction.z);
                const View view = look_at(position, target, radius);
                EXPECT_EQ(view.eye, glm::dvec4(position, 1));
                const glm::dvec4 middle = view.world_to_clip * glm::dvec4(target, 1);
                EXPECT_GT(middle.w, 0);
                if (distance > 1e9) // the sphere is too small a part of the distance for its points to be told apart
                    continue;
                for (const glm::dvec3& point : points_on_sphere(target, radius)) {
                    const glm::dvec4 clip = view.world_to_clip * glm::dvec4(point, 1);
                    EXPECT_LE(clip.z, clip.w);
                    // Where the eye is inside the sphere, what is beside or behind it cannot be seen.
                    if (distance > 1) {
                        EXPECT_GE(clip.z, -clip.w);
                    }
                }
            }
}

TEST(View, LookAtShowsTheViewAngleFromTopToBottom)
{
    const View view = look_at({0, 0, 10}, {0, 0, 0}, 1, 60, {300, 150});
    const double half_height = 10 * std::tan(std::acos(-1.0) / 6);
    const glm::dvec3 corner = projected(view, {2 * half_height, half_height, 0});
    EXPECT_NEAR(corner.x, 1, 1e-14);
    EXPECT_NEAR(corner.y, 1, 1e-14);
}

TEST(View, ParallelHoldsTheSphereTightly)
{
    const glm::dvec3 target(1, 2, 3);
    for (const glm::ivec2 size : {glm::ivec2(512, 512), glm::ivec2(300, 100), glm::ivec2(100, 300)})
        for (const double scale : {1.0, 1e-200, 1e200})
            for (const glm::dvec3& direction : directions()) {
                const View view = parallel(scale * direction, target, 5, size);
                EXPECT_EQ(view.eye, glm::dvec4(scale * direction, 0));
                glm::dvec3 most(0);
                for (const glm::dvec3& point : points_on_sphere(target, 5))
                    most = glm::max(most, glm::abs(projected(view, point)));
                EXPECT_LE(most.x, 1 + 1e-14);
                EXPECT_LE(most.y, 1 + 1e-14);
                EXPECT_LT(most.z, 1);
                EXPECT_GT(std::max(most.x, most.y), 0.95);
                // Nearer points are nearer in depth.
                EXPECT_LT(projected(view, target + glm::normalize(direction)).z, projected(view, target).z);
            }
}

TEST(View, FarFromTheOriginTheDirectionKeepsItsDigits)
{
    const glm::dvec3 target(1, 0, 0);
    const View view = look_at({1, 0, 1e12}, target, 1e6);
    const glm::dvec3 middle = projected(view, target);
    EXPECT_EQ(middle.x, 0);
    EXPECT_EQ(middle.y, 0);
}

TEST(View, CamerasThatShowNothingAreNamed)
{
    const auto fault_after = [](const std::function<void(Camera&)>& change) {
        return fault([&] {
            Camera camera;
            change(camera);
            view_of(camera, {640, 480});
        });
    };
    EXPECT_EQ(fault_after([](Camera&) {}), "");
    EXPECT_EQ(fault_after([](Camera& c) { c.focal_point = c.position; }),
              "the focal point lies at (0, 0, 1), the camera's position");
    EXPECT_EQ(fault_after([](Camera& c) {
                  c.up = {0, 0, -7};
              }),
              "camera up vector (0, 0, -7) is zero or lies along the view");
    EXPECT_EQ(fault_after([](Camera& c) {
                  c.up = {0, 0, 0};
              }),
              "camera up vector (0, 0, 0) is zero or lies along the view");
    EXPECT_EQ(fault_after([](Camera& c) { c.position.x = nan; }), "camera position (nan, 0, 1) is not finite");
    EXPECT_EQ(fault_after([](Camera& c) { c.focal_point.y = infinity; }),
              "camera focal point (0, inf, 0) is not finite");
    EXPECT_EQ(fault_after([](Camera& c) { c.up.y = nan; }), "camera up vector (0, nan, 0) is not finite");
    EXPECT_EQ(fault_after([](Camera& c) {
                  c.position.x = 1.5e308;
                  c.focal_point.x = -1.5e308;
              }),
              "the view direction (inf, 0, 1) is not finite");
    EXPECT_EQ(fault_after([](Camera& c) { c.view_angle = 180; }), "view angle 180: must lie between 0 and 180 degrees");
    EXPECT_EQ(fault_after([](Camera& c) { c.view_angle = nan; }), "view angle nan: must lie between 0 and 180 degrees");
    EXPECT_EQ(fault_after([](Camera& c) { c.near = 0; }),
              "clipping planes at 0 and 1000: must ascend, from above 0 for a perspective camera");
    EXPECT_EQ(fault_after([](Camera& c) { c.far = c.near; }),
              "clipping planes at 0.01 and 0.01: must ascend, from above 0 for a perspective camera");
    EXPECT_EQ(fault_after([](Camera& c) {
                  c.parallel = true;
                  c.parallel_scale = 0;
              }),
              "parallel scale 0: must be positive and finite");

    EXPECT_EQ(fault([] { view_of(Camera{}, {0, 480}); }), "view size 0 x 480: must be at least 1 x 1");
    EXPECT_EQ(fault([] { look_at({1, 2, 3}, {1, 2, 3}, 1); }), "the target lies at (1, 2, 3), the camera's position");
    EXPECT_EQ(fault([] { look_at({1, 2, 3}, {0, 0, 0}, -1); }), "radius -1 of the view: must be positive and finite");
    EXPECT_EQ(fault([] { look_at({1, 2, 3}, {0, 0, 0}, 1, 0); }), "view angle 0: must lie between 0 and 180 degrees");
    EXPECT_EQ(fault([] { parallel({0, 0, 0}, {0, 0, 0}, 1); }), "camera direction (0, 0, 0) points nowhere");
    EXPECT_EQ(fault([] {
                  parallel({0, 0, 1}, {0, 0, 0}, infinity);
              }),
              "radius inf of the view: must be positive and finite");
}

TEST(View, ValidateRefusesEyesThatAreNoPoint)
{
    const auto fault_of = [](const glm::dvec4& eye) {
        return fault([&] { validate(View{eye, glm::dmat4(1), {1, 1}}); });
    };
    EXPECT_EQ(fault_of({0, 0, 0, 1}), "");
    EXPECT_EQ(fault_of({0, 0, 0, -1}), "");
    EXPECT_EQ(fault_of({0, 1e-320, 0, 0}), "");
    EXPECT_EQ(fault_of({0, -0.0, 0, 0}), "eye (0, -0, 0, 0) is no point");
    EXPECT_EQ(fault_of({0, nan, 0, 1}), "eye (0, nan, 0, 1) is not finite");
    EXPECT_EQ(fault_of({0, 0, 0, infinity}), "eye (0, 0, 0, inf) is not finite");
}

TEST(View, StandsUprightAsItIsTold)
{
    const glm::dvec3 target(1, 2, 3);
    for (const glm::dvec3& up :
         {glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0), glm::dvec3(3, 1, -2), glm::dvec3(1e200, 0, 0)})
        for (const glm::dvec3& towards : directions()) {
            const glm::dvec3 unit = glm::normalize(up / std::max({std::abs(up.x), std::abs(up.y), std::abs(up.z)}));
            if (glm::length(glm::cross(unit, glm::normalize(towards))) < 1e-6)
                continue;
            for (const View& view : {look_at(target + 9.0 * towards, target, 2, 30, {64, 64}, {up, true}),
                                     parallel(towards, target, 2, {64, 64}, {up, true})}) {
                const glm::dvec3 above = projected(view, target + 1e-3 * unit);
                EXPECT_NEAR(above.x, 0, 1e-9);
                EXPECT_GT(above.y, 0);
            }
        }
}

TEST(View, RefusesAnUprightAlongTheViewOnlyIfItIsRequired)
{
    const auto fault_of = [](const Upright& upright) {
        const std::string of_parallel = fault([&] { parallel({0, 0, 2}, {0, 0, 0}, 1, {8, 8}, upright); });
        EXPECT_EQ(of_parallel, fault([&] { look_at({0, 0, 2}, {0, 0, 0}, 1, 30, {8, 8}, upright); }));
        return of_parallel;
    };
    EXPECT_EQ(fault_of({{0, 0, -3}, true}), "up vector (0, 0, -3) lies along the view");
    EXPECT_EQ(fault_of({{0, 0, -3}, false}), "");
    EXPECT_EQ(fault_of({{0, 1, -3}, true}), "");
    EXPECT_EQ(fault_of({{0, 0, 0}, false}), "up vector (0, 0, 0) points nowhere");
    EXPECT_EQ(fault_of({{0, nan, 0}, false}), "up vector (0, nan, 0) is not finite");
    // Then y is up, or z where y lies along the view.
    EXPECT_GT(projected(parallel({0, 0, 1}, {0, 0, 0}, 1, {8, 8}, {{0, 0, 1}, false}), {0, 0.5, 0}).y, 0.4);
    EXPECT_GT(projected(parallel({0, 1, 0}, {0, 0, 0}, 1, {8, 8}, {{0, 1, 0}, false}), {0, 0, 0.5}).y, 0.4);
}

TEST(View, HasZUpForWhatIsFlatAlongZ)
{
    const auto up_for = [](const glm::dvec3& size) {
        const Upright upright = upright_for(Box{glm::dvec3(-5), glm::dvec3(-5) + size});
        EXPECT_FALSE(upright.required);
        return upright.up;
    };
    const glm::dvec3 y(0, 1, 0), z(0, 0, 1);
    EXPECT_EQ(up_for({8, 9, 1}), z);
    EXPECT_EQ(up_for({8, 9, 0}), z);
    EXPECT_EQ(up_for({1, 1, 1}), y);
    EXPECT_EQ(up_for({9, 1, 1}), y);
    EXPECT_EQ(up_for({9, 1, 9}), y);
    EXPECT_EQ(up_for({0, 0, 0}), y);
    EXPECT_EQ(up_for({9, 0, 0}), y);
    EXPECT_EQ(upright_for(Box{glm::dvec3(-1.7e308), glm::dvec3(1.7e308, 1.7e308, -1.6e308)}).up, z);
}

} // namespace
} // namespace visorder::tests
