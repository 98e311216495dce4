#include "scenes/lattice.h"
#include "scenes/portable_numbers.h"
#include "scenes/scene_families.h"
#include "scenes/unused_points.h"

#include <algorithm>
#include <glm/vec3.hpp>

namespace visorder::scenes {

namespace {

constexpr std::size_t teeth = 16;
constexpr double bore_radius = 1;
constexpr double root_radius = 2.5;
constexpr double tip_radius = 3.25;
constexpr double thickness = 1.5;

// A wheel of rings of hexahedra, of which the outer ones have gaps between the teeth, as wide as these. Each layer of
// points along the axis is turned against the first, the last by `twist` turns.
Mesh gear(std::size_t cells, double twist)
{
    // The rings outside the root are half empty: they count half.
    constexpr double rim = root_radius - bore_radius;
    constexpr double tooth = tip_radius - root_radius;
    constexpr double half_pitch = 0.4; // half way between bore and tip
    const LatticeSize size = lattice_size((cells + 3) / 6 / teeth, {half_pitch, 2 * rim + tooth, thickness}, {1, 3, 1});
    const std::size_t columns = size[0]; // of a tooth
    const std::size_t layers = size[2];
    std::size_t tooth_rings = std::max<std::size_t>(1, size[1] / 5);
    tooth_rings += (size[1] - tooth_rings) % 2;
    const std::size_t rim_rings = (size[1] - tooth_rings) / 2;
    const std::size_t around = 2 * teeth * columns;

    const auto radius = [&](std::size_t ring) {
        return ring <= rim_rings
                   ? bore_radius + rim * static_cast<double>(ring) / static_cast<double>(rim_rings)
                   : root_radius + tooth * static_cast<double>(ring - rim_rings) / static_cast<double>(tooth_rings);
    };
    Mesh mesh;
    for (std::size_t k = 0; k <= layers; ++k) {
        const double height = static_cast<double>(k) / static_cast<double>(layers);
        for (std::size_t j = 0; j < around; ++j) {
            const double turns = static_cast<double>(j) / static_cast<double>(around) + twist * height;
            const glm::dvec3 direction(cosine_of_turns(turns), sine_of_turns(turns), 0);
            for (std::size_t i = 0; i <= rim_rings + tooth_rings; ++i)
                mesh.points.push_back(radius(i) * direction + glm::dvec3(0, 0, thickness * height));
        }
    }
    add_hexahedra(mesh, {rim_rings + tooth_rings + 1, around, layers + 1}, true,
                  [&](const LatticeSize& corner) { return corner[0] < rim_rings || corner[1] / columns % 2 == 0; });
    drop_unused_points(mesh);
    return mesh;
}

} // namespace

Mesh gear_scene(std::size_t cells, std::uint64_t)
{
    return gear(cells, 0);
}

Mesh helical_gear_scene(std::size_t cells, std::uint64_t)
{
    return gear(cells, 0.5 / teeth);
}

} // namespace visorder::scenes
