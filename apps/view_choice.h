#pragma once

#include "visorder/scene.h"
#include "visorder/view.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace visorder::apps {

/// Where to look from, as the command line says: --eye X,Y,Z or --direction X,Y,Z, or neither; and --up X,Y,Z.
struct ViewChoice {
    std::vector<double> eye;
    std::vector<double> direction; ///< towards the viewer
    std::vector<double> up;
    CLI::Option* up_option = nullptr;
};

std::shared_ptr<ViewChoice> add_view_choice(CLI::App& command);

/// Adds --up alone.
CLI::Option* add_up_option(CLI::App& command, std::vector<double>& up);

/// What --up says. Throws InputError for what is no direction.
glm::dvec3 up_direction(const std::vector<double>& up);

/// The same, or what suits the scene where nothing is said.
Upright upright_of(const std::vector<double>& up, const Scene& scene);

/// Directions that suit a picture of which `up` is up, at right angles to it and to each other: without a better
/// reason, right is along x, and front, towards the viewer, along z, or against y where z is up.
struct ViewAxes {
    glm::dvec3 right, up, front;
};
ViewAxes view_axes(const glm::dvec3& up);

/// A view of the whole scene from there; by default a three-quarter view of it. Without a view angle it is 30 degrees,
/// or, from an eye that is given, what it takes for all of the scene to be seen and not to be less than a tenth of the
/// picture high and wide: from within the scene, of which some is not seen, 120 degrees. Throws InputError where no
/// such eye can be, and for --up along the view.
View view_of(const ViewChoice& choice, const Scene& scene, glm::ivec2 size = {512, 512},
             std::optional<double> view_angle = std::nullopt);

} // namespace visorder::apps
