#include "layering/xmpvo_layered.h"

#include "geometry/exact_predicates.h"
#include "visorder/error.h"

#include <algorithm>
#include <numeric>
#include <oneapi/tbb/parallel_sort.h>

namespace visorder::detail {

namespace {

// Depths so near to each other that rounding may have them in the wrong order, relative to them.
constexpr float no_difference = 0x1p-22f;

const Scene& solids(const Scene& scene)
{
    if (scene.is_surface())
        throw InputError("xmpvo-layered orders solid cells; the triangles of a surface have no exits");
    return scene;
}

// By two pixels on each side, where there are such.
PixelRectangle enlarged(const PixelRectangle& part, glm::ivec2 size)
{
    if (part.pixel_count() == 0)
        return part;
    const glm::ivec2 low = glm::max(part.from - 2, glm::ivec2(0));
    return {low, glm::min(part.from + part.size + 2, size) - low};
}

// Makes a part of the image the whole, in clip space.
glm::dmat4 onto_image(const PixelRectangle& part, glm::ivec2 size)
{
    const glm::dvec2 scale = glm::dvec2(size) / glm::dvec2(part.size);
    const glm::dvec2 middle = (2.0 * glm::dvec2(part.from) + glm::dvec2(part.size)) / glm::dvec2(size) - 1.0;
    glm::dmat4 result(1);
    for (int axis = 0; axis < 2; ++axis) {
        result[axis][axis] = scale[axis];
        result[3][axis] = -middle[axis] * scale[axis];
    }
    return result;
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

// Adds to pairs_ those of exit and entry faces that follow each other at a pixel; returns where there are any.
PixelRectangle XmpvoLayered::find_pairs(const glm::dmat4& world_to_clip, glm::ivec2 size)
{
    project(items_, drawn_, scene_.mesh().points, world_to_clip, size, triangles_);
    buffer_->set(triangles_, size);
    std::vector<std::uint32_t> items;
    for (std::uint32_t item = 0; item < items_.item_count(); ++item)
        if (triangles_.begin[item] < triangles_.begin[item + 1])
            items.push_back(item);
    FacePairs found;
    std::vector<RayHit> hits;
    glm::ivec2 low = size, high(0);
    sequences_->visit(items, buffer_->whole(), [&](std::span<const Fragment> pixel) {
        hits.clear();
        float place = 0;
        bool left = false, back = false;
        for (std::size_t i = 0; i < pixel.size(); ++i) {
            if (i > 0 && pixel[i - 1].depth - pixel[i].depth > no_difference * pixel[i].depth)
                ++place;
            hits.push_back({place, pixel[i].item});
            back = back || (left && sides_[pixel[i].item] == Sign::positive);
            left = left || sides_[pixel[i].item] == Sign::negative;
        }
        found.add(hits, sides_, 0);
        deepest_ = std::max(deepest_, pixel.size());
        if (back) {
            const glm::ivec2 at(static_cast<int>(pixel[0].pixel) % size.x, static_cast<int>(pixel[0].pixel) / size.x);
            low = glm::min(low, at);
            high = glm::max(high, at + 1);
        }
    });
    pairs_.insert(pairs_.end(), found.pairs().begin(), found.pairs().end());
    work_.rendering_s += sequences_->rendering_s();
    work_.reading_s += sequences_->reading_s();
    work_.passes += static_cast<std::size_t>(sequences_->passes());
    work_.fragments_read += sequences_->fragment_count();
    return {low, glm::max(high - low, glm::ivec2(0))};
}

void XmpvoLayered::sort(const View& view, Order& order)
{
    validate(view);
    signs_.evaluate(scene_, view.eye);
    face_sides(scene_, signs_, sides_);
    drawn_.resize(sides_.size());
    std::transform(sides_.begin(), sides_.end(), drawn_.begin(), [](Sign side) { return side != Sign::zero ? 1 : 0; });
    const glm::ivec2 size = size_.x > 0 ? size_ : view.size;
    pairs_.clear();
    work_ = {};
    deepest_ = 0;
    {
        const Context::Current current(context_);
        const PixelRectangle part = enlarged(find_pairs(view.world_to_clip, size), size);
        if (part.pixel_count() > 0 && 2 * part.pixel_count() <= buffer_->whole().pixel_count())
            find_pairs(onto_image(part, size) * view.world_to_clip, size);
        context_.check();
    }
    oneapi::tbb::parallel_sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    confirm_pairs(scene_, view.eye, pairs_, relations_);
    topological_sort_.run(scene_, signs_, relations_, order);
}

std::size_t XmpvoLayered::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return size_of(items_.triangles) + size_of(items_.begin) + buffer_->bytes() + sequences_->bytes() +
           size_of(triangles_.triangles) + size_of(triangles_.begin) + signs_.bytes() + size_of(sides_) +
           size_of(drawn_) + size_of(pairs_) + size_of(relations_) + topological_sort_.bytes();
}

std::vector<Statistic> XmpvoLayered::statistics() const
{
    return {{"layers", static_cast<double>(deepest_)},
            {"fragments", static_cast<double>(work_.fragments_read)},
            {"passes", static_cast<double>(work_.passes)},
            {"rendering, s", work_.rendering_s},
            {"reading, s", work_.reading_s},
            {"pairs of faces", static_cast<double>(pairs_.size())},
            {"relations", static_cast<double>(relations_.size())}};
}

} // namespace visorder::detail
