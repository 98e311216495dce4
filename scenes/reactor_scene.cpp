#include "scenes/lattice.h"
#include "scenes/scene_families.h"
#include "scenes/unused_points.h"

#include <algorithm>
#include <glm/vec3.hpp>

namespace visorder::scenes {

Mesh reactor_scene(std::size_t cells, std::uint64_t)
{
    // Channels and the walls between and around them are two cells wide; cells are twice as long as wide.
    const std::size_t hexahedra = (cells + 3) / 6;
    const auto side = [](std::size_t channels) { return 4 * channels + 2; };
    const auto in_layer = [&](std::size_t channels) {
        return side(channels) * side(channels) - 4 * channels * channels;
    };
    std::size_t channels = 1;
    while (in_layer(channels + 1) * side(channels + 1) / 2 <= hexahedra)
        ++channels;
    const std::size_t layers = std::max<std::size_t>(1, (hexahedra + in_layer(channels) / 2) / in_layer(channels));

    Mesh mesh;
    for (std::size_t k = 0; k <= layers; ++k)
        for (std::size_t j = 0; j <= side(channels); ++j)
            for (std::size_t i = 0; i <= side(channels); ++i)
                mesh.points.emplace_back(i, j, 2 * k);
    add_hexahedra(mesh, {side(channels) + 1, side(channels) + 1, layers + 1}, false,
                  [](const LatticeSize& corner) { return corner[0] % 4 < 2 || corner[1] % 4 < 2; });
    drop_unused_points(mesh);
    return mesh;
}

} // namespace visorder::scenes
