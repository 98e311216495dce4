#pragma once

#include "visorder/mesh.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace visorder::scenes {

/// A family of scenes that are made, not read, by its name.
struct GeneratedScene {
    const char* name;
    const char* summary;
    std::size_t default_cells;
};

std::span<const GeneratedScene> generated_scenes();

/// The scene NAME[:SIZE[:SEED]]: about SIZE tetrahedra, the hexahedra that subdivide into as many, or, in a surface
/// scene, SIZE triangles, and a smooth scalar in [0, 1] at every point. The same specification gives the same mesh, bit
/// by bit, on every machine. SEED, 1 unless given, chooses the random numbers; families without any take it and are the
/// same for all. What each family's scenes are like stands in scene_families.h. Throws InputError for an unknown name
/// (and lists those known), a SIZE that is not a number, too small for the family or above 2^29, and a SEED that is not
/// a number below 2^64.
Mesh generate(std::string_view specification);

} // namespace visorder::scenes
