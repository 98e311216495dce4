#include "visorder/checking.h"

#include "checking/convex_body.h"
#include "checking/image_boxes.h"
#include "checking/order_positions.h"
#include "checking/planar_faces.h"
#include "geometry/box_hierarchy.h"
#include "parallel/large_array.h"
#include "sorting/strongly_connected.h"
#include "visorder/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder {

using namespace detail;

namespace {

using Pair = std::pair<CellId, CellId>;

// What of the cells found so far holds, in the inner numbering.
struct Found {
    std::vector<Relation> relations;
    std::vector<Pair> overlapping;
};

Found find_relations(const Scene& scene, const glm::dvec4& eye)
{
    const Mesh& mesh = scene.mesh();
    const std::vector<Box> boxes = image_boxes(scene, eye);
    const BoxHierarchy hierarchy(boxes);
    std::vector<std::uint8_t> counts(scene.cell_count());
    oneapi::tbb::parallel_for(CellId{0}, scene.cell_count(),
                              [&](CellId cell) { counts[cell] = can_occlude(mesh, cell, eye) ? 1 : 0; });
    oneapi::tbb::enumerable_thread_specific<Found> parts;
    oneapi::tbb::parallel_for(CellId{0}, scene.cell_count(), [&](CellId a) {
        if (counts[a] == 0)
            return;
        Found& found = parts.local();
        const ConvexBody of_a = body_of(mesh, a);
        Box shadow = boxes[a];
        shadow.min.z = -std::numeric_limits<double>::infinity();
        shadow.max.z = std::numeric_limits<double>::infinity();
        hierarchy.search([&](const Box& box) { return box.meets(shadow); },
                         [&](CellId b) {
                             if (b <= a || counts[b] == 0)
                                 return true;
                             const ConvexBody of_b = body_of(mesh, b);
                             const bool a_first = boxes[a].min.z <= boxes[b].max.z && occludes(of_a, of_b, eye);
                             const bool b_first = boxes[b].min.z <= boxes[a].max.z && occludes(of_b, of_a, eye);
                             if (a_first && b_first)
                                 found.overlapping.emplace_back(a, b);
                             else if (a_first)
                                 found.relations.push_back({a, b});
                             else if (b_first)
                                 found.relations.push_back({b, a});
                             return true;
                         });
    });
    Found all;
    for (const Found& part : parts) {
        all.relations.insert(all.relations.end(), part.relations.begin(), part.relations.end());
        all.overlapping.insert(all.overlapping.end(), part.overlapping.begin(), part.overlapping.end());
    }
    std::sort(all.relations.begin(), all.relations.end());
    return all;
}

} // namespace

DirectRelations::DirectRelations(const Scene& scene, const glm::dvec4& eye, const DirectOptions& options)
    : scene_(scene), eye_(eye.w < 0 ? -eye : eye)
{
    validate(View{eye, glm::dmat4(1), glm::ivec2(1)});
    if (scene.cell_count() > options.max_cells)
        throw InputError(
            fmt::format("{} cells: all pairs are tried in scenes of up to {}", scene.cell_count(), options.max_cells));
    require_planar_faces(scene);
    Found found = find_relations(scene, eye_);
    relations_ = std::move(found.relations);
    const auto caller = scene.caller_cells();
    for (const auto& [a, b] : found.overlapping)
        overlapping_.push_back(std::minmax(caller[a], caller[b]));
    std::sort(overlapping_.begin(), overlapping_.end());
    find_unorderable();
}

void DirectRelations::find_unorderable()
{
    std::vector<std::uint32_t> from, to;
    for (const Relation& relation : relations_) {
        from.push_back(relation.front);
        to.push_back(relation.back);
    }
    const Components components = strongly_connected_components(graph_of(scene_.cell_count(), from, to));
    std::vector<std::vector<CellId>> members(components.count);
    const auto caller = scene_.caller_cells();
    for (CellId cell = 0; cell < scene_.cell_count(); ++cell)
        members[components.of_node[cell]].push_back(caller[cell]);
    set_of_.assign(scene_.cell_count(), 0);
    for (CellId cell = 0; cell < scene_.cell_count(); ++cell)
        if (members[components.of_node[cell]].size() > 1)
            set_of_[cell] = components.of_node[cell] + 1;
    std::erase_if(members, [](const auto& set) { return set.size() < 2; });
    for (std::vector<CellId>& set : members)
        std::sort(set.begin(), set.end());
    std::sort(members.begin(), members.end());
    unorderable_ = std::move(members);
}

CheckResult DirectRelations::check(const Order& order, CheckOptions options) const
{
    const LargeArray<std::uint32_t> place = order_positions(scene_, order);
    CheckResult result;
    result.relations = relations_.size();
    result.overlapping = overlapping_;
    result.unorderable = unorderable_;
    const auto caller = scene_.caller_cells();
    struct Wrong {
        Pair caller;
        Relation inner;
    };
    std::vector<Wrong> wrong;
    for (const Relation& relation : relations_) {
        if (place[relation.front] > place[relation.back])
            continue;
        if (set_of_[relation.front] != 0 && set_of_[relation.front] == set_of_[relation.back])
            ++result.violations_in_cycles;
        else
            wrong.push_back({{caller[relation.front], caller[relation.back]}, relation});
    }
    result.violations = wrong.size();
    std::sort(wrong.begin(), wrong.end(), [](const Wrong& a, const Wrong& b) { return a.caller < b.caller; });
    wrong.resize(std::min(wrong.size(), options.max_witnesses));
    for (const Wrong& w : wrong)
        result.witnesses.push_back(
            {w.caller.first, w.caller.second,
             occlusion_witness(body_of(scene_.mesh(), w.inner.front), body_of(scene_.mesh(), w.inner.back), eye_)});
    return result;
}

} // namespace visorder
