#include "scenes/lattice.h"
#include "scenes/portable_numbers.h"
#include "scenes/scene_families.h"

#include <glm/vec3.hpp>

namespace visorder::scenes {

Mesh tori_scene(std::size_t cells, std::uint64_t)
{
    // From the middle of a ring to the middle of its square section, and from there to a side.
    constexpr double ring_radius = 1;
    constexpr double half_width = 0.3;
    const LatticeSize size =
        lattice_size((cells + 3) / 6 / 2, {2 * half_width, 6.28 * ring_radius, 2 * half_width}, {1, 8, 1});
    const auto across = [&](std::size_t i, std::size_t steps) {
        return half_width * (2 * static_cast<double>(i) / static_cast<double>(steps) - 1);
    };

    Mesh mesh;
    for (const bool second : {false, true}) {
        for (std::size_t k = 0; k <= size[2]; ++k)
            for (std::size_t j = 0; j < size[1]; ++j) {
                const double turns = static_cast<double>(j) / static_cast<double>(size[1]);
                for (std::size_t i = 0; i <= size[0]; ++i) {
                    const double radius = ring_radius + across(i, size[0]);
                    const glm::dvec3 point(radius * cosine_of_turns(turns), radius * sine_of_turns(turns),
                                           across(k, size[2]));
                    // The second stands upright and passes through the middle of the first.
                    mesh.points.push_back(second ? glm::dvec3(point.y + ring_radius, point.z, point.x) : point);
                }
            }
        add_hexahedra(mesh, {size[0] + 1, size[1], size[2] + 1}, true);
    }
    return mesh;
}

} // namespace visorder::scenes
