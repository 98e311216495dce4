#pragma once

#include "scenes/generated_scene.h"
#include "scenes/views.h"
#include "visorder/scene.h"

#include <string>
#include <utility>
#include <vector>

namespace visorder::tests {

/// The specification of a family's scene of few cells: some families have a least number.
inline std::string small_specification(const scenes::GeneratedScene& family)
{
    const std::string name = family.name;
    return name + (name == "cavity" ? ":2000" : name == "gear-helical" ? ":900" : ":600");
}

/// The hard views of a scene and some random ones, perspective and parallel.
inline std::vector<scenes::NamedView> all_views(const Scene& scene)
{
    std::vector<scenes::NamedView> views = scenes::hard_views(scene, {64, 64});
    for (scenes::NamedView& view : scenes::random_views(scene, 6, 2, {64, 64}))
        views.push_back(std::move(view));
    return views;
}

} // namespace visorder::tests
