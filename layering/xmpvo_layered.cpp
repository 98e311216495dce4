#include "layering/xmpvo_layered.h"

#include "scene/error.h"
#include "sorting/registry.h"

#include <algorithm>
#include <numeric>
#include <oneapi/tbb/parallel_sort.h>

namespace visorder {

namespace {

// Depths so near to each other that rounding may have them in the wrong order, relative to them.
constexpr float no_difference = 0x1p-22f;

const Scene& solids(const Scene& scene)
{
    if (scene.is_surface())
        throw InputError("xmpvo-layered orders solid cells; the triangles of a surface have no exits");
    return scene;
}

} // namespace

XmpvoLayered::XmpvoLayered(const Scene& scene, GlPlatform platform, glm::ivec2 size)
    : scene_(solids(scene)), size_(size), items_(boundary_items(scene)), context_(platform)
{
    scene.face_planes();
    const Context::Current current(context_);
    buffer_.emplace(context_);
    sequences_.emplace(*buffer_);
}

Guarantee XmpvoLayered::guarantee() const
{
    return scene_.traits().convex ? Guarantee::exact : Guarantee::approximate;
}

// Fills pairs_ with those of exit and entry faces that follow each other at a pixel.
void XmpvoLayered::find_pairs()
{
    std::vector<std::uint32_t> drawn;
    for (std::uint32_t item = 0; item < items_.item_count(); ++item)
        if (triangles_.begin[item] < triangles_.begin[item + 1])
            drawn.push_back(item);
    FacePairs found;
    std::vector<RayHit> hits;
    deepest_ = 0;
    sequences_->visit(drawn, buffer_->whole(), [&](std::span<const Fragment> pixel) {
        hits.clear();
        float place = 0;
        for (std::size_t i = 0; i < pixel.size(); ++i) {
            if (i > 0 && pixel[i - 1].depth - pixel[i].depth > no_difference * pixel[i].depth)
                ++place;
            hits.push_back({place, pixel[i].item});
        }
        found.add(hits, sides_, 0);
        deepest_ = std::max(deepest_, pixel.size());
    });
    pairs_ = found.pairs();
    oneapi::tbb::parallel_sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

void XmpvoLayered::sort(const View& view, Order& order)
{
    validate(view);
    signs_.evaluate(scene_, view.eye);
    face_sides(scene_, signs_, sides_);
    std::vector<std::uint8_t> drawn(sides_.size());
    std::transform(sides_.begin(), sides_.end(), drawn.begin(), [](Sign side) { return side != Sign::zero ? 1 : 0; });
    const glm::ivec2 size = size_.x > 0 ? size_ : view.size;
    {
        const Context::Current current(context_);
        project(items_, drawn, scene_.mesh().points, view.world_to_clip, size, triangles_);
        buffer_->set(triangles_, size);
        find_pairs();
        context_.check();
    }
    confirm_pairs(scene_, view.eye, pairs_, relations_);
    topological_sort_.run(scene_, signs_, relations_, order);
}

std::size_t XmpvoLayered::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return size_of(items_.triangles) + size_of(items_.begin) + buffer_->bytes() + sequences_->bytes() +
           size_of(triangles_.triangles) + size_of(triangles_.begin) + signs_.bytes() + size_of(sides_) +
           size_of(pairs_) + size_of(relations_) + topological_sort_.bytes();
}

std::vector<Statistic> XmpvoLayered::statistics() const
{
    return {{"layers", static_cast<double>(deepest_)},
            {"fragments", static_cast<double>(sequences_->fragment_count())},
            {"passes", static_cast<double>(sequences_->passes())},
            {"rendering, s", sequences_->rendering_s()},
            {"reading, s", sequences_->reading_s()},
            {"pairs of faces", static_cast<double>(pairs_.size())},
            {"relations", static_cast<double>(relations_.size())}};
}

std::unique_ptr<Sorter> make_xmpvo_layered(const Scene& scene, const SorterOptions& options)
{
    return std::make_unique<XmpvoLayered>(scene, gl_platform(options.gl), options.layer_size);
}

} // namespace visorder
