#include "apps/view_choice.h"

#include "scene/error.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace visorder::apps {

namespace {

glm::dvec3 triple(const std::vector<double>& numbers, const char* option)
{
    if (numbers.size() != 3)
        throw InputError(std::string(option) + " takes three numbers, X,Y,Z");
    return {numbers[0], numbers[1], numbers[2]};
}

// From the right, above and in front, as far away as shows all of a sphere.
glm::dvec3 three_quarter_eye(const glm::dvec3& middle, double radius, double view_angle)
{
    const glm::dvec3 towards = glm::normalize(glm::dvec3(0.6, 0.5, 1));
    return middle + towards * (1.02 * radius / std::sin(glm::radians(view_angle) / 2));
}

} // namespace

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
    return choice;
}

View view_of(const ViewChoice& choice, const Scene& scene, glm::ivec2 size, double view_angle)
{
    const glm::dvec3 middle = scene.bounds().middle();
    const glm::dvec3 half = scene.bounds().max * 0.5 - scene.bounds().min * 0.5;
    const double length = glm::length(half);
    const double radius = length > 0 && std::isfinite(length) ? length : 1;
    if (!choice.direction.empty()) {
        const glm::dvec3 direction = triple(choice.direction, "--direction");
        View view{glm::dvec4(direction, 0), glm::dmat4(1), size};
        validate(view);
        view.world_to_clip = parallel(direction, middle, radius, size).world_to_clip;
        return view;
    }
    const glm::dvec3 eye =
        choice.eye.empty() ? three_quarter_eye(middle, radius, view_angle) : triple(choice.eye, "--eye");
    View view{glm::dvec4(eye, 1), glm::dmat4(1), size};
    validate(view);
    // An eye at the very middle looks down an axis.
    const glm::dvec3 target = eye == middle ? eye - glm::dvec3(0, 0, radius) : middle;
    view.world_to_clip = look_at(eye, target, radius, view_angle, size).world_to_clip;
    return view;
}

} // namespace visorder::apps
