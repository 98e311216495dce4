#include "apps/view_choice.h"

#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace visorder::apps {

namespace {

constexpr double default_angle = 30;
constexpr double widest_angle = 160;
constexpr double angle_within = 120; // for what reaches beside the eye or behind it
constexpr double margin = 1.02;
constexpr double least_part = 0.1; // of the picture that a scene should cover

glm::dvec3 triple(const std::vector<double>& numbers, const char* option)
{
    if (numbers.size() != 3)
        throw InputError(std::string(option) + " takes three numbers, X,Y,Z");
    return {numbers[0], numbers[1], numbers[2]};
}

// From the right, above and in front, as far away as shows all of a sphere.
glm::dvec3 three_quarter_eye(const glm::dvec3& middle, double radius, double view_angle, glm::ivec2 size,
                             const glm::dvec3& up)
{
    const ViewAxes axes = view_axes(up);
    const glm::dvec3 towards = glm::normalize(0.6 * axes.right + 0.5 * axes.up + axes.front);
    const double narrower =
        std::atan(std::tan(glm::radians(view_angle) / 2) * std::min(1.0, static_cast<double>(size.x) / size.y));
    return middle + towards * (margin * radius / std::sin(narrower));
}

// The view angle at which all of a box is seen that is seen from an eye at `angle` degrees by `view`.
double fitting_angle(const View& view, const Box& box, double angle)
{
    double most = 0; // of the image's half width and height, how much the box takes
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                               (corner & 4) != 0 ? box.max.z : box.min.z);
        const glm::dvec4 clip = view.world_to_clip * glm::dvec4(point, 1);
        if (!(clip.w > 0))
            return angle_within;
        most = std::max({most, std::abs(clip.x) / clip.w, std::abs(clip.y) / clip.w});
    }
    if (!std::isfinite(most) || (most <= 1 && most >= least_part) || most == 0)
        return angle;
    const double fitting = 2 * glm::degrees(std::atan(margin * most * std::tan(glm::radians(angle) / 2)));
    return std::min(widest_angle, fitting);
}

} // namespace

CLI::Option* add_up_option(CLI::App& command, std::vector<double>& up)
{
    return command
        .add_option("--up", up,
                    "The direction that is up in the picture, X,Y,Z (default: z for a scene that is flat along it, "
                    "else y)")
        ->delimiter(',')
        ->expected(1, 3)
        ->allow_extra_args(false);
}

std::shared_ptr<ViewChoice> add_view_choice(CLI::App& command)
{
    auto choice = std::make_shared<ViewChoice>();
    CLI::Option* eye = command
                           .add_option("--eye", choice->eye,
                                       "Position of the eye, X,Y,Z (default: from the right, above and in front)")
                           ->delimiter(',')
                           ->expected(1, 3)
                           ->allow_extra_args(false);
    command.add_option("--direction", choice->direction, "Direction towards a viewer infinitely far away, X,Y,Z")
        ->delimiter(',')
        ->expected(1, 3)
        ->allow_extra_args(false) // which follow it, as the order of `check`
        ->excludes(eye);
    choice->up_option = add_up_option(command, choice->up);
    return choice;
}

glm::dvec3 up_direction(const std::vector<double>& up)
{
    const glm::dvec3 direction = triple(up, "--up");
    if (direction == glm::dvec3(0) || !std::isfinite(direction.x) || !std::isfinite(direction.y) ||
        !std::isfinite(direction.z))
        throw InputError(fmt::format("--up {},{},{}: must be a direction", direction.x, direction.y, direction.z));
    return direction;
}

Upright upright_of(const std::vector<double>& up, const Scene& scene)
{
    return up.empty() ? upright_for(scene.bounds()) : Upright{up_direction(up), true};
}

ViewAxes view_axes(const glm::dvec3& up)
{
    const glm::dvec3 size = glm::abs(up);
    const glm::dvec3 direction = glm::normalize(up / std::max({size.x, size.y, size.z}));
    const bool along_z = size.z > size.x && size.z > size.y;
    const glm::dvec3 before = along_z ? glm::dvec3(0, -1, 0) : glm::dvec3(0, 0, 1);
    const glm::dvec3 front = glm::normalize(before - direction * glm::dot(before, direction));
    return {glm::cross(direction, front), direction, front};
}

View view_of(const ViewChoice& choice, const Scene& scene, glm::ivec2 size, std::optional<double> view_angle)
{
    const glm::dvec3 middle = scene.bounds().middle();
    const glm::dvec3 half = scene.bounds().max * 0.5 - scene.bounds().min * 0.5;
    const double length = glm::length(half);
    const double radius = length > 0 && std::isfinite(length) ? length : 1;
    const Upright upright = upright_of(choice.up, scene);
    if (!choice.direction.empty()) {
        const glm::dvec3 direction = triple(choice.direction, "--direction");
        View view{glm::dvec4(direction, 0), glm::dmat4(1), size};
        validate(view);
        view.world_to_clip = parallel(direction, middle, margin * radius, size, upright).world_to_clip;
        return view;
    }
    const bool by_default = choice.eye.empty();
    double angle = view_angle.value_or(default_angle);
    const glm::dvec3 eye =
        by_default ? three_quarter_eye(middle, radius, angle, size, upright.up) : triple(choice.eye, "--eye");
    View view{glm::dvec4(eye, 1), glm::dmat4(1), size};
    validate(view);
    // An eye at the very middle looks down an axis.
    const glm::dvec3 target = eye == middle ? eye - radius * view_axes(upright.up).front : middle;
    view.world_to_clip = look_at(eye, target, radius, angle, size, upright).world_to_clip;
    if (!by_default && !view_angle) {
        angle = fitting_angle(view, scene.bounds(), angle);
        view.world_to_clip = look_at(eye, target, radius, angle, size, upright).world_to_clip;
    }
    return view;
}

} // namespace visorder::apps
