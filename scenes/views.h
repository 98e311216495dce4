#pragma once

#include "visorder/scene.h"
#include "visorder/view.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace visorder::scenes {

/// A view, and in words where from, so that a table or a failing test can name it.
struct NamedView {
    std::string name;
    View view;
};

/// Views of the whole scene from random directions, alternately perspective (from 1 to 3 radii off the bounding sphere)
/// and parallel. The first `count` of the endless sequence that `seed` starts; the same on every machine. What is up
/// in them: `up`, if given, where it does not lie along the view; else what suits the scene.
std::vector<NamedView> random_views(const Scene& scene, int count, std::uint64_t seed, glm::ivec2 size,
                                    const std::optional<glm::dvec3>& up = std::nullopt);

/// The views from which orders go wrong first: from a vertex, a point on an interior and on a boundary face, inside a
/// cell, a corner of the bounding box, in the plane of many faces, a trillionth and a billion box sizes away, and along
/// each axis in parallel projection. `up` as above.
std::vector<NamedView> hard_views(const Scene& scene, glm::ivec2 size,
                                  const std::optional<glm::dvec3>& up = std::nullopt);

} // namespace visorder::scenes
