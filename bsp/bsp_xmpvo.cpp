#include "bsp/bsp_xmpvo.h"

#include "bsp/bsp_merge.h"
#include "scene/face_overlap.h"
#include "sorting/registry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <utility>

namespace visorder {

namespace {

// How far from the eye points are, in slabs of the scene's depth: a guess at the order, no decision.
class Depth {
public:
    Depth(const Box& bounds, const glm::dvec4& eye, std::uint16_t slabs) : eye_(eye), slabs_(slabs)
    {
        const glm::dvec3 half = bounds.max * 0.5 - bounds.min * 0.5;
        const double radius = std::sqrt(glm::dot(half, half));
        const double middle = of(bounds.middle());
        const double unit = eye.w == 0 ? std::sqrt(glm::dot(glm::dvec3(eye), glm::dvec3(eye))) : 1.0;
        nearest_ = eye.w == 0 ? middle - radius * unit : std::max(middle - radius, 0.0);
        slabs_per_unit_ = slabs_ / (middle + radius * unit - nearest_);
    }

    std::uint16_t slab(const glm::dvec3& point) const
    {
        const double slab = (of(point) - nearest_) * slabs_per_unit_;
        return slab >= slabs_ ? static_cast<std::uint16_t>(slabs_ - 1)
               : slab > 0     ? static_cast<std::uint16_t>(slab)
                              : std::uint16_t{0};
    }

private:
    double of(const glm::dvec3& point) const
    {
        if (eye_.w == 0)
            return -glm::dot(glm::dvec3(eye_), point);
        const glm::dvec3 from_eye = point - glm::dvec3(eye_) / eye_.w;
        return std::sqrt(glm::dot(from_eye, from_eye));
    }

    glm::dvec4 eye_;
    std::uint16_t slabs_;
    double nearest_ = 0;
    double slabs_per_unit_ = 0;
};

std::vector<std::uint8_t> with_area(const BspTree& tree)
{
    std::vector<std::uint8_t> has_area(tree.faces().size());
    for (std::size_t i = 0; i < has_area.size(); ++i)
        has_area[i] = tree.group_counts()[i] > 0;
    return has_area;
}

} // namespace

BspXmpvo::BspXmpvo(const Scene& scene, std::uint64_t seed)
    : scene_(scene),
      tree_(scene, seed),
      boundary_cells_(tree_.faces(), scene.cell_count()),
      corners_(scene.mesh(), tree_.faces(), with_area(tree_)),
      heights_(scene, tree_.faces(), corners_),
      images_(corners_)
{
    scene.overlapping_cells();
}

void BspXmpvo::look_at_faces(const glm::dvec4& eye)
{
    const std::span<const CellFace> faces = tree_.faces();
    const ProjectionCharts charts(scene_.bounds(), eye);
    roles_.resize(faces.size());
    is_listed_.assign(boundary_cells_.count(), 0);
    waiting_head_.assign(boundary_cells_.count(), no_cell);
    next_.resize(boundary_cells_.count());
    slabs_.resize(boundary_cells_.count());
    deferred_.assign(slab_count, no_cell);
    boxes_.reset(faces.size(), charts.count());
    const Depth depth(scene_.bounds(), eye, slab_count);
    has_images_ = charts.has_images();
    if (has_images_)
        images_.project(charts);
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(0, boundary_cells_.count(), 1024), [&](const auto& range) {
            for (std::size_t cell = range.begin(); cell < range.end(); ++cell) {
                slabs_[cell] = no_slab;
                const auto [begin, end] = boundary_cells_.faces(cell);
                for (std::uint32_t i = begin; i < end; ++i) {
                    roles_[i] = tree_.group_counts()[i] == 0 ? 0 : role(i, eye);
                    if (roles_[i] == 0)
                        continue;
                    if (has_images_)
                        boxes_.set(i, 0, images_.box(i));
                    else
                        set_boxes(i, charts);
                    if ((roles_[i] & exit_role) != 0) {
                        const std::uint16_t slab = depth.slab(corners_.points()[corners_.of(i)[0]]);
                        slabs_[cell] = slabs_[cell] == no_slab ? slab : std::max(slabs_[cell], slab);
                    }
                }
            }
        });
}

void BspXmpvo::reset_pending()
{
    pending_.reset(boxes_, ranks_, [&](std::uint32_t face) { return (roles_[face] & entry_role) != 0; });
    listed_in_step_.clear();
    tests_ = {};
    relation_count_ = 0;
}

void BspXmpvo::walk(const glm::dvec4& eye)
{
    const std::size_t faces = tree_.faces().size();
    ranks_.last.assign(faces, 0);
    ranks_.first.assign(faces, 0xffff);
    const std::size_t groups = std::max<std::size_t>(tree_.node_count(), 1);
    std::size_t group_count = 0;
    tree_.walk(eye, [&](std::span<const std::uint32_t> group) {
        const auto rank = static_cast<std::uint16_t>(group_count * 65536 / groups);
        for (std::uint32_t face : group) {
            ranks_.last[face] = rank;
            ranks_.first[face] = std::min(ranks_.first[face], rank);
        }
        ++group_count;
    });
}

void BspXmpvo::set_boxes(std::uint32_t face, const ProjectionCharts& charts)
{
    std::array<glm::dvec3, 4> points;
    const FaceCorners::Corners& corners = corners_.of(face);
    for (std::size_t k = 0; k < 4; ++k)
        points[k] = corners_.points()[corners[k]];
    const auto count = static_cast<std::size_t>(FaceCorners::count(corners));
    for (int chart = 0; chart < charts.count(); ++chart)
        if (const auto box = charts.box(std::span(points).first(count), chart))
            boxes_.set(face, chart, *box);
}

std::uint8_t BspXmpvo::role(std::uint32_t face, const glm::dvec4& eye) const
{
    if (scene_.is_surface())
        return corners_.seen(face, eye).turn == Sign::zero ? 0 : exit_role | entry_role;
    const CellFace& of_cell = tree_.faces()[face];
    return (signs_.exit(of_cell.cell) >> of_cell.face & 1u) != 0    ? exit_role
           : (signs_.entry(of_cell.cell) >> of_cell.face & 1u) != 0 ? entry_role
                                                                    : 0;
}

bool BspXmpvo::obstructs(std::uint32_t f, std::uint32_t g, const glm::dvec4& eye, Tests& tests) const
{
    ++tests.all;
    const Sure nearer = heights_.nearer(f, g);
    if (nearer == Sure::no)
        return false;
    const Shared shared = has_images_ ? images_.shared(f, g) : Shared::unknown;
    if (shared == Shared::nothing)
        return false;
    const CellId front = tree_.faces()[f].cell, back = tree_.faces()[g].cell;
    if (front == back)
        return false;
    if (!scene_.is_surface() && scene_.adjacency().joins(front, back))
        return false; // the face between them carries the relation
    if (!(nearer == Sure::yes && shared == Shared::area) && !covers_exactly(f, g, eye, tests))
        return false;
    const auto& overlapping = scene_.overlapping_cells();
    const std::pair<CellId, CellId> pair = std::minmax(front, back);
    return !std::binary_search(overlapping.begin(), overlapping.end(), pair);
}

bool BspXmpvo::covers_exactly(std::uint32_t f, std::uint32_t g, const glm::dvec4& eye, Tests& tests) const
{
    const SeenFace front = corners_.seen(f, eye), back = corners_.seen(g, eye);
    if (surely_not_nearer(front, back))
        return false;
    ++tests.exact;
    const Overlap overlap = face_overlap(front, back, eye);
    return overlap == Overlap::nearer || (overlap == Overlap::coincident && !scene_.is_surface());
}

template <int row, class State>
bool BspXmpvo::sort_by(LargeArray<State>& state, const glm::dvec4& eye, Order& order)
{
    const CellId cells = scene_.cell_count();
    state.resize(cells);
    resize_on_large_pages(order.back_to_front, cells);
    BspMerge<row, State> merge(*this, state.data(), eye, order);
    if (merge.run() < cells)
        return false;
    order.layer_begin.clear();
    order.cycles.clear();
    return true;
}

void BspXmpvo::sort(const View& view, Order& order)
{
    validate(view);
    oneapi::tbb::parallel_invoke([&] { walk(view.eye); },
                                 [&] {
                                     if (!scene_.is_surface())
                                         signs_.evaluate(scene_, view.eye);
                                 });
    look_at_faces(view.eye);
    const bool complete = scene_.is_surface()                  ? sort_by<0>(small_state_, view.eye, order)
                          : scene_.adjacency().row_length == 4 ? sort_by<4>(small_state_, view.eye, order)
                                                               : sort_by<6>(large_state_, view.eye, order);
    if (!complete)
        sort_with_cycles(view.eye, order);
}

void BspXmpvo::sort_with_cycles(const glm::dvec4& eye, Order& order)
{
    boundary_relations(scene_, eye, all_relations_);
    if (scene_.is_surface())
        topological_sort_.run(scene_, all_relations_.relations, order);
    else
        topological_sort_.run(scene_, signs_, all_relations_.relations, order);
    order.layer_begin.clear();
}

std::size_t BspXmpvo::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return tree_.bytes() + signs_.bytes() + size_of(small_state_) + size_of(large_state_) + size_of(roles_) +
           size_of(ranks_.first) + size_of(ranks_.last) + size_of(is_listed_) + size_of(queue_) +
           size_of(waiting_head_) + corners_.bytes() + heights_.bytes() + images_.bytes() + size_of(next_) +
           size_of(slabs_) + size_of(deferred_) + size_of(looking_) + size_of(covered_) + size_of(listed_in_step_) +
           boxes_.bytes() + pending_.bytes() + size_of(all_relations_.relations) + topological_sort_.bytes();
}

std::vector<Statistic> BspXmpvo::statistics() const
{
    const auto as_double = [](std::size_t count) { return static_cast<double>(count); };
    return {{"nodes", as_double(tree_.node_count())}, {"splits", as_double(tree_.split_count())},
            {"depth", as_double(tree_.depth())},      {"pair tests", as_double(tests_.all)},
            {"exact tests", as_double(tests_.exact)}, {"relations", as_double(relation_count_)}};
}

std::unique_ptr<Sorter> make_bsp_xmpvo(const Scene& scene, const SorterOptions& options)
{
    return std::make_unique<BspXmpvo>(scene, options.bsp_seed);
}

} // namespace visorder
