#include "layering/layers_sorter.h"

#include "geometry/exact_predicates.h"
#include "visorder/error.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace visorder::detail {

namespace {

// Grows with the distance of a triangle's centre.
double distance_key(const ItemMesh& items, std::span<const glm::dvec3> points, std::uint32_t item, const View& view)
{
    const auto& triangle = items.triangles[item];
    const glm::dvec3 centre = points[triangle[0]] / 3.0 + points[triangle[1]] / 3.0 + points[triangle[2]] / 3.0;
    const glm::dvec3 eye(view.eye);
    return view.eye.w != 0 ? glm::distance(centre, eye / view.eye.w) : -glm::dot(centre, eye);
}

} // namespace

LayersSorter::LayersSorter(const Scene& scene, LayerVariant variant, GlPlatform platform, glm::ivec2 size, int block)
    : scene_(scene),
      items_(scene.is_surface()
                 ? surface_items(scene)
                 : throw InputError("the layers sorters order the triangles of a surface; for solids there is "
                                    "xmpvo-layered")),
      size_(size),
      context_(platform)
{
    const Context::Current current(context_);
    extraction_ = std::make_unique<LayerExtraction>(context_, variant, block);
}

void LayersSorter::sort(const View& view, Order& order)
{
    validate(view);
    const std::vector<glm::dvec3>& points = scene_.mesh().points;
    drawn_.resize(items_.triangles.size());
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
        const auto& [a, b, c] = items_.triangles[i];
        drawn_[i] = side_of_plane(points[a], points[b], points[c], view.eye) != Sign::zero ? 1 : 0;
    }
    const Context::Current current(context_);
    extraction_->run(items_, drawn_, points, view.world_to_clip, size_.x > 0 ? size_ : view.size, layers_);
    write(view, order);
}

void LayersSorter::write(const View& view, Order& order) const
{
    std::vector<std::uint8_t> in_cycle(layers_.layer.size(), 0);
    std::vector<std::uint32_t> unlayered;
    for (const Layers::Unproven& unproven : layers_.unproven)
        if (unproven.reason == WithoutProof::cycle)
            in_cycle[unproven.item] = 1;
        else
            unlayered.push_back(unproven.item);
    const auto farthest_first = [&](std::vector<std::uint32_t>& items) {
        std::vector<std::pair<double, std::uint32_t>> keys;
        keys.reserve(items.size());
        for (std::uint32_t item : items)
            keys.emplace_back(-distance_key(items_, scene_.mesh().points, item, view), item);
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 0; i < items.size(); ++i)
            items[i] = keys[i].second;
    };
    farthest_first(unlayered);

    // Counted, then put in their places: layer 0 first, then the farthest, and so on to layer 1.
    std::vector<std::uint32_t> begin(layers_.count + std::size_t{2}, 0);
    const auto place = [&](std::uint32_t layer) { return layer == 0 ? 0 : layers_.count + 1 - layer; };
    for (std::uint32_t layer : layers_.layer)
        ++begin[place(layer) + 1];
    for (std::size_t i = 1; i < begin.size(); ++i)
        begin[i] += begin[i - 1];
    order.layer_begin.clear();
    for (std::size_t i = 0; i + 1 < begin.size(); ++i)
        if (begin[i] < begin[i + 1])
            order.layer_begin.push_back(begin[i]);
    order.back_to_front.resize(layers_.layer.size());
    std::copy(unlayered.begin(), unlayered.end(), order.back_to_front.begin());
    for (std::uint32_t item = 0; item < layers_.layer.size(); ++item)
        if (layers_.layer[item] != 0 && in_cycle[item] == 0)
            order.back_to_front[begin[place(layers_.layer[item])]++] = item;
    order.cycles = layers_.cycles;
    for (std::vector<std::uint32_t> cycle : layers_.cycles) {
        farthest_first(cycle);
        for (std::uint32_t item : cycle)
            order.back_to_front[begin[place(layers_.layer[item])]++] = item;
    }
}

std::size_t LayersSorter::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return size_of(items_.triangles) + size_of(items_.begin) + extraction_->bytes() + size_of(drawn_) +
           size_of(layers_.layer) + size_of(layers_.unproven);
}

std::vector<Statistic> LayersSorter::statistics() const
{
    const auto count = [&](WithoutProof reason) {
        return static_cast<double>(
            std::count_if(layers_.unproven.begin(), layers_.unproven.end(),
                          [&](const Layers::Unproven& unproven) { return unproven.reason == reason; }));
    };
    const auto all = static_cast<double>(layers_.layer.size());
    const LayerWork& done = work();
    return {{"layers", static_cast<double>(layers_.count)},
            {"covering no sample point", count(WithoutProof::no_sample), all},
            {"edge-on", count(WithoutProof::edge_on), all},
            {"in cycles at this resolution", count(WithoutProof::cycle), all},
            {"passes", static_cast<double>(done.passes)},
            {"pixels read", static_cast<double>(done.pixels_read)},
            {"words of flags read", static_cast<double>(done.flags_read)},
            {"fragments read", static_cast<double>(done.fragments_read)},
            {"rendering, s", done.rendering_s, done.total_s()},
            {"reading, s", done.reading_s, done.total_s()},
            {"scanning, s", done.scanning_s, done.total_s()},
            {"rest, s", done.rest_s, done.total_s()}};
}

} // namespace visorder::detail
