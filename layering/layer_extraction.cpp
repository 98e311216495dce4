#include "layering/layer_extraction.h"

#include "scene/stopwatch.h"
#include "sorting/strongly_connected.h"
#include "visorder/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace visorder::detail {

namespace {

constexpr std::uint32_t most_layers_by_passes = 255;
constexpr int most_passes = 8; // of step 4, for one layer

std::unique_ptr<LayerScan> make_scan(const Context& context, LayerVariant variant, int block)
{
    if (variant == LayerVariant::compute)
        return make_compute_scan(context);
    if (block < 1)
        throw InputError(fmt::format("blocks of {} pixels: must be at least 1", block));
    return make_readback_scan(variant == LayerVariant::blocked ? block : 0);
}

// Takes `removed` out of `items`; both ascend.
void remove(std::vector<std::uint32_t>& items, const std::vector<std::uint32_t>& removed,
            std::vector<std::uint32_t>& kept)
{
    kept.clear();
    std::set_difference(items.begin(), items.end(), removed.begin(), removed.end(), std::back_inserter(kept));
    items.swap(kept);
}

// Which items follow which, pixel by pixel, without the repetitions of neighbouring pixels.
class Successions {
public:
    void add(std::span<const Fragment> pixel)
    {
        for (std::size_t i = 1; i < pixel.size(); ++i) {
            const std::uint64_t pair = std::uint64_t{pixel[i - 1].item} << 32 | pixel[i].item;
            std::uint64_t& last = latest_[pair * 0x9e3779b97f4a7c15u >> 50];
            if (last != pair && pixel[i - 1].item != pixel[i].item)
                pairs_.push_back(last = pair);
        }
        for (const Fragment& fragment : pixel)
            if (shown_.empty() || shown_.back() != fragment.item)
                shown_.push_back(fragment.item);
    }

    // Ascending; (front, back).
    std::vector<std::uint64_t> pairs() { return sorted(pairs_); }
    std::vector<std::uint32_t> shown() { return sorted(shown_); }

private:
    template <class T>
    static std::vector<T> sorted(std::vector<T>& values)
    {
        std::sort(values.begin(), values.end());
        values.erase(std::unique(values.begin(), values.end()), values.end());
        return std::move(values);
    }

    std::vector<std::uint64_t> latest_ = std::vector<std::uint64_t>(std::size_t{1} << 14, 0);
    std::vector<std::uint64_t> pairs_;
    std::vector<std::uint32_t> shown_;
};

// Gives layers from `first` on to the nodes of a graph from front to back; nodes of one cycle share theirs.
class LayersOfGraph {
public:
    LayersOfGraph(const Graph& graph, std::uint32_t first)
        : components_(strongly_connected_components(graph)), layer_of_component_(components_.count, first)
    {
        std::vector<std::uint32_t> nodes(graph.node_count());
        members_begin_.assign(components_.count + std::size_t{1}, 0);
        for (std::uint32_t component : components_.of_node)
            ++members_begin_[component];
        std::uint32_t end = 0;
        for (std::uint32_t& count : members_begin_)
            count = end += count;
        for (std::uint32_t node = graph.node_count(); node-- > 0;)
            nodes[--members_begin_[components_.of_node[node]]] = node;
        members_ = std::move(nodes);
        // Edges lead to lower numbers.
        for (std::uint32_t component = components_.count; component-- > 0;)
            for (std::uint32_t node : members(component))
                for (std::uint32_t successor : graph.of(node)) {
                    std::uint32_t& layer = layer_of_component_[components_.of_node[successor]];
                    if (components_.of_node[successor] != component)
                        layer = std::max(layer, layer_of_component_[component] + 1);
                }
    }

    std::uint32_t layer(std::uint32_t node) const { return layer_of_component_[components_.of_node[node]]; }
    std::uint32_t component_count() const { return components_.count; }
    std::span<const std::uint32_t> members(std::uint32_t component) const
    {
        return {members_.data() + members_begin_[component], members_.data() + members_begin_[component + 1]};
    }

private:
    Components components_;
    std::vector<std::uint32_t> layer_of_component_;
    std::vector<std::uint32_t> members_begin_;
    std::vector<std::uint32_t> members_;
};

} // namespace

const char* name(WithoutProof reason)
{
    switch (reason) {
    case WithoutProof::no_sample:
        return "covers no sample point";
    case WithoutProof::edge_on:
        return "edge-on";
    case WithoutProof::cycle:
        return "in a cycle";
    }
    return "";
}

LayerExtraction::LayerExtraction(const Context& context, LayerVariant variant, int block)
    : context_(&context), buffer_(context), scan_(make_scan(context, variant, block)), sequences_(buffer_)
{
}

void LayerExtraction::run(const ItemMesh& items, std::span<const std::uint8_t> drawn,
                          std::span<const glm::dvec3> points, const glm::dmat4& world_to_clip, glm::ivec2 size,
                          Layers& layers)
{
    work_ = {};
    Stopwatch watch;
    project(items, drawn, points, world_to_clip, size, triangles_);
    buffer_.set(triangles_, size);
    scan_->begin(buffer_, work_);
    layers.count = 0;
    layers.layer.assign(items.item_count(), 0);
    layers.cycles.clear();
    layers.unproven.clear();
    rest_.clear();
    for (std::uint32_t item = 0; item < items.item_count(); ++item)
        if (triangles_.begin[item] < triangles_.begin[item + 1])
            rest_.push_back(item);
    while (!rest_.empty() && extract_layer(layers))
        ;
    for (std::uint32_t item = 0; item < items.item_count(); ++item)
        if (layers.layer[item] == 0)
            layers.unproven.push_back({item, drawn[item] != 0 ? WithoutProof::no_sample : WithoutProof::edge_on});
    std::sort(layers.unproven.begin(), layers.unproven.end(),
              [](const Layers::Unproven& a, const Layers::Unproven& b) { return a.item < b.item; });
    context_->check();
    work_.rest_s = watch.lap() - work_.rendering_s - work_.reading_s - work_.scanning_s;
}

// Returns whether another layer may follow.
bool LayerExtraction::extract_layer(Layers& layers)
{
    const GlFunctions& gl = context_->gl();
    Stopwatch watch;
    buffer_.draw_nearest(rest_, scan_->alive());
    gl.Finish();
    ++work_.passes;
    work_.rendering_s += watch.lap();
    scan_->find_candidates(candidates_);
    if (candidates_.empty())
        return false;
    if (layers.count == most_layers_by_passes)
        return take_apart(layers);
    LayerScan::Outcome outcome{true, false};
    for (int pass = 1; outcome.again && !candidates_.empty(); ++pass) {
        watch.lap();
        buffer_.draw_farthest(candidates_, scan_->alive());
        gl.Finish();
        ++work_.passes;
        work_.rendering_s += watch.lap();
        covered_.clear();
        outcome = scan_->find_covered(candidates_, covered_);
        remove(candidates_, covered_, kept_);
        // The passes would be very many, or (a folded face may lie behind itself) without end.
        if (outcome.saturated || (outcome.again && (pass == most_passes || covered_.empty()))) {
            watch.lap();
            covered_.clear();
            work_.flags_read += buffer_.find_covered(candidates_, scan_->alive(), covered_);
            ++work_.passes;
            remove(candidates_, covered_, kept_);
            work_.rendering_s += watch.lap();
            break;
        }
    }
    if (candidates_.empty())
        return take_apart(layers);
    ++layers.count;
    for (std::uint32_t item : candidates_)
        layers.layer[item] = layers.count;
    remove(rest_, candidates_, kept_);
    return true;
}

// Of all that is left. Returns that no layer may follow.
bool LayerExtraction::take_apart(Layers& layers)
{
    Successions successions;
    sequences_.visit(rest_, scan_->alive(), [&](std::span<const Fragment> pixel) { successions.add(pixel); });
    work_.rendering_s += sequences_.rendering_s();
    work_.reading_s += sequences_.reading_s();
    work_.passes += static_cast<std::size_t>(sequences_.passes());
    work_.fragments_read += sequences_.fragment_count();

    const std::vector<std::uint32_t> shown = successions.shown();
    const auto node_of = [&](std::uint64_t item) {
        return static_cast<std::uint32_t>(std::lower_bound(shown.begin(), shown.end(), item) - shown.begin());
    };
    std::vector<std::uint32_t> from, to;
    for (std::uint64_t pair : successions.pairs()) {
        from.push_back(node_of(pair >> 32));
        to.push_back(node_of(pair & 0xffffffffu));
    }
    const Graph graph = graph_of(static_cast<std::uint32_t>(shown.size()), from, to);
    const LayersOfGraph found(graph, layers.count + 1);
    for (std::uint32_t node = 0; node < shown.size(); ++node) {
        layers.layer[shown[node]] = found.layer(node);
        layers.count = std::max(layers.count, found.layer(node));
    }
    for (std::uint32_t component = 0; component < found.component_count(); ++component) {
        const auto members = found.members(component);
        if (members.size() < 2)
            continue;
        std::vector<std::uint32_t>& cycle = layers.cycles.emplace_back();
        for (std::uint32_t node : members) {
            cycle.push_back(shown[node]);
            layers.unproven.push_back({shown[node], WithoutProof::cycle});
        }
    }
    std::sort(layers.cycles.begin(), layers.cycles.end());
    return false;
}

std::size_t LayerExtraction::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return buffer_.bytes() + scan_->bytes() + sequences_.bytes() + size_of(triangles_.triangles) +
           size_of(triangles_.begin) + size_of(rest_) + size_of(candidates_) + size_of(covered_) + size_of(kept_);
}

} // namespace visorder::detail
