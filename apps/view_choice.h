#pragma once

#include "scene/scene.h"
#include "scene/view.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <vector>

namespace visorder::apps {

/// Where to look from, as the command line says: --eye X,Y,Z or --direction X,Y,Z, or neither.
struct ViewChoice {
    std::vector<double> eye;
    std::vector<double> direction; ///< towards the viewer
};

std::shared_ptr<ViewChoice> add_view_choice(CLI::App& command);

/// A view of the whole scene from there; by default a three-quarter view of it. Throws InputError where no such eye can
/// be.
View view_of(const ViewChoice& choice, const Scene& scene, glm::ivec2 size = {512, 512}, double view_angle = 30);

} // namespace visorder::apps
