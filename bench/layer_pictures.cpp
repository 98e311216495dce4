#include "bench/layer_pictures.h"

#include "bench/painting.h"
#include "files/image_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace visorder::bench {

using namespace detail;

namespace {

// Hues as far apart as can be from one layer to the next.
std::vector<glm::dvec3> colours_of(const Layers& layers)
{
    constexpr double golden = 0.618034;
    std::vector<glm::dvec3> colours(layers.layer.size());
    for (std::size_t item = 0; item < colours.size(); ++item) {
        const double hue = std::fmod(0.58 + golden * layers.layer[item], 1.0);
        for (int k = 0; k < 3; ++k) {
            const double away = std::abs(std::fmod(6 * hue + 6 - 2 * k, 6.0) - 3); // 3 at this channel's own hue
            colours[item][k] = 0.32 + 0.6 * std::clamp(away - 1, 0.0, 1.0);
        }
    }
    for (const Layers::Unproven& unproven : layers.unproven)
        colours[unproven.item] = glm::dvec3(0.6);
    return colours;
}

} // namespace

std::uint32_t write_layer_pictures(const Mesh& mesh, LayersSorter& sorter, const View& view, const View& turned,
                                   const std::filesystem::path& folder)
{
    std::filesystem::create_directories(folder);
    Order order, from_behind;
    sorter.sort(turned, from_behind);
    sorter.sort(view, order);
    const Layers& layers = sorter.layers();
    const std::vector<glm::dvec3> colours = colours_of(layers);
    const PngStyle as_they_are{.to_srgb = false};
    write_png(paint(mesh, order.back_to_front, view, colours), folder / "layers.png", as_they_are);
    write_png(paint(mesh, from_behind.back_to_front, turned, colours), folder / "turned.png", as_they_are);
    for (std::uint32_t layer = 1; layer <= layers.count; ++layer) {
        std::vector<CellId> alone;
        std::copy_if(order.back_to_front.begin(), order.back_to_front.end(), std::back_inserter(alone),
                     [&](CellId cell) { return layers.layer[cell] == layer; });
        write_png(paint(mesh, alone, view, colours), folder / fmt::format("layer-{:03}.png", layer), as_they_are);
    }
    return layers.count;
}

} // namespace visorder::bench
