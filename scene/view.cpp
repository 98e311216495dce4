#include "visorder/view.h"

#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace visorder {

namespace {

bool is_finite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double largest_component(const glm::dvec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The direction of a vector that is neither zero nor infinite, also where its squared length over- or underflows.
glm::dvec3 direction_of(const glm::dvec3& v)
{
    return glm::normalize(v / largest_component(v));
}

/// Whether two unit vectors are parallel as far as choosing the picture's upright needs it; no order depends on it.
bool along(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::length(glm::cross(a, b)) < 1e-9;
}

void check_size(glm::ivec2 size)
{
    if (size.x < 1 || size.y < 1)
        throw InputError(fmt::format("view size {} x {}: must be at least 1 x 1", size.x, size.y));
}

void check_vector(const char* what, const glm::dvec3& v)
{
    if (!is_finite(v))
        throw InputError(fmt::format("{} ({}, {}, {}) is not finite", what, v.x, v.y, v.z));
}

void check_radius(double radius)
{
    if (!std::isfinite(radius) || radius <= 0)
        throw InputError(fmt::format("radius {} of the view: must be positive and finite", radius));
}

/// The vector from a camera to what it looks at, or back. Throws InputError where it has no direction.
glm::dvec3 difference(const char* what, const glm::dvec3& from, const glm::dvec3& to)
{
    const glm::dvec3 d = to - from;
    if (largest_component(d) == 0)
        throw InputError(fmt::format("{} lies at ({}, {}, {}), the camera's position", what, to.x, to.y, to.z));
    check_vector("the view direction", d);
    return d;
}

double aspect(glm::ivec2 size)
{
    return static_cast<double>(size.x) / size.y;
}

/// World to camera coordinates: `origin` becomes zero, `forward` (a unit vector) the negative z axis. The rotation is
/// found apart from the position, of which it would lose digits far from the origin.
glm::dmat4 world_to_camera(const glm::dvec3& origin, const glm::dvec3& forward, const glm::dvec3& up)
{
    return glm::translate(glm::lookAtRH(glm::dvec3(0), forward, up), -origin);
}

View make_view(const glm::dvec4& eye, const glm::dmat4& camera_to_clip, const glm::dmat4& world_to_camera,
               glm::ivec2 size)
{
    const View view{eye, camera_to_clip * world_to_camera, size};
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(view.world_to_clip[column][row]))
                throw InputError("the camera's numbers are too large or too small for a projection matrix");
    return view;
}

glm::dmat4 perspective_to_clip(double view_angle, double near, double far, glm::ivec2 size)
{
    if (!std::isfinite(view_angle) || view_angle <= 0 || view_angle >= 180)
        throw InputError(fmt::format("view angle {}: must lie between 0 and 180 degrees", view_angle));
    return glm::perspectiveRH_NO(glm::radians(view_angle), aspect(size), near, far);
}

glm::dmat4 parallel_to_clip(double half_height, double near, double far, glm::ivec2 size)
{
    const double half_width = half_height * aspect(size);
    return glm::orthoRH_NO(-half_width, half_width, -half_height, half_height, near, far);
}

/// The direction that is up in a view along `forward`.
glm::dvec3 upright_for(const glm::dvec3& forward, const Upright& upright)
{
    check_vector("up vector", upright.up);
    if (largest_component(upright.up) == 0)
        throw InputError("up vector (0, 0, 0) points nowhere");
    const glm::dvec3 up = direction_of(upright.up);
    if (!along(forward, up))
        return up;
    if (upright.required)
        throw InputError(
            fmt::format("up vector ({}, {}, {}) lies along the view", upright.up.x, upright.up.y, upright.up.z));
    const glm::dvec3 y(0, 1, 0);
    return along(forward, y) ? glm::dvec3(0, 0, 1) : y;
}

/// How many times as wide as it is high something flat is.
constexpr double flatness = 4;

/// Beyond a sphere's radius, so that rounding does not clip the points where it touches a clipping plane.
constexpr double slack = 1.01;

} // namespace

View view_of(const Camera& camera, glm::ivec2 size)
{
    check_size(size);
    check_vector("camera position", camera.position);
    check_vector("camera focal point", camera.focal_point);
    check_vector("camera up vector", camera.up);
    const glm::dvec3 backward = difference("the focal point", camera.focal_point, camera.position);
    const glm::dvec3 forward = -direction_of(backward);
    if (largest_component(camera.up) == 0 || along(forward, direction_of(camera.up)))
        throw InputError(fmt::format("camera up vector ({}, {}, {}) is zero or lies along the view", camera.up.x,
                                     camera.up.y, camera.up.z));
    if (!std::isfinite(camera.near) || !std::isfinite(camera.far) || camera.near >= camera.far ||
        (!camera.parallel && camera.near <= 0))
        throw InputError(fmt::format("clipping planes at {} and {}: must ascend, from above 0 for a perspective camera",
                                     camera.near, camera.far));
    if (camera.parallel && (!std::isfinite(camera.parallel_scale) || camera.parallel_scale <= 0))
        throw InputError(fmt::format("parallel scale {}: must be positive and finite", camera.parallel_scale));

    const glm::dmat4 to_camera = world_to_camera(camera.position, forward, direction_of(camera.up));
    if (camera.parallel)
        return make_view(glm::dvec4(backward, 0),
                         parallel_to_clip(camera.parallel_scale, camera.near, camera.far, size), to_camera, size);
    return make_view(glm::dvec4(camera.position, 1),
                     perspective_to_clip(camera.view_angle, camera.near, camera.far, size), to_camera, size);
}

Upright upright_for(const Box& bounds)
{
    const glm::dvec3 half = bounds.max * 0.5 - bounds.min * 0.5; // which cannot overflow
    const bool flat = flatness * half.z <= std::min(half.x, half.y) && half.x > 0 && half.y > 0;
    return {flat ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0), false};
}

View look_at(glm::dvec3 position, glm::dvec3 target, double radius, double view_angle, glm::ivec2 size,
             const Upright& upright)
{
    check_size(size);
    check_vector("camera position", position);
    check_vector("camera target", target);
    check_radius(radius);
    const glm::dvec3 to_target = difference("the target", position, target);
    const glm::dvec3 forward = direction_of(to_target);
    const double distance = std::hypot(to_target.x, to_target.y, to_target.z);
    // From inside the sphere, or close to it, the near plane stays in front of the eye by a part of the depth that a
    // depth buffer resolves; from so far that the sphere's depth is lost in rounding, the planes still differ.
    const double beyond = distance + slack * radius;
    const double near = std::max(distance - slack * radius, 1e-4 * beyond);
    const double far = std::max(beyond, near * (1 + 1e-9));
    return make_view(glm::dvec4(position, 1), perspective_to_clip(view_angle, near, far, size),
                     world_to_camera(position, forward, upright_for(forward, upright)), size);
}

View parallel(glm::dvec3 towards_viewer, glm::dvec3 target, double radius, glm::ivec2 size, const Upright& upright)
{
    check_size(size);
    check_vector("camera direction", towards_viewer);
    check_vector("camera target", target);
    check_radius(radius);
    if (largest_component(towards_viewer) == 0)
        throw InputError("camera direction (0, 0, 0) points nowhere");
    const glm::dvec3 forward = -direction_of(towards_viewer);
    const double half_height = radius / std::min(1.0, aspect(size));
    return make_view(glm::dvec4(towards_viewer, 0),
                     parallel_to_clip(half_height, -slack * radius, slack * radius, size),
                     world_to_camera(target, forward, upright_for(forward, upright)), size);
}

void validate(const View& view)
{
    const glm::dvec4& eye = view.eye;
    if (!is_finite(glm::dvec3(eye)) || !std::isfinite(eye.w))
        throw InputError(fmt::format("eye ({}, {}, {}, {}) is not finite", eye.x, eye.y, eye.z, eye.w));
    if (eye == glm::dvec4(0))
        throw InputError(fmt::format("eye ({}, {}, {}, {}) is no point", eye.x, eye.y, eye.z, eye.w));
}

} // namespace visorder
