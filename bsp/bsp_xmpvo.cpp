#include "bsp/bsp_xmpvo.h"

#include "bsp/bsp_merge.h"
#include "geometry/exact_predicates.h"
#include "scene/adjacency.h"
#include "scene/overlap_planes.h"
#include "sorting/tentative_relations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <utility>

namespace visorder::detail {

namespace {

// How far from the eye points are, in slabs of the scene's depth: a guess at the order, no decision.
class Depth {
public:
    Depth(const Box& bounds, const glm::dvec4& eye, std::uint8_t slabs) : eye_(eye), slabs_(slabs)
    {
        const glm::dvec3 half = bounds.max * 0.5 - bounds.min * 0.5;
        const double radius = std::sqrt(glm::dot(half, half));
        const double middle = of(bounds.middle());
        const double unit = eye.w == 0 ? std::sqrt(glm::dot(glm::dvec3(eye), glm::dvec3(eye))) : 1.0;
        nearest_ = eye.w == 0 ? middle - radius * unit : std::max(middle - radius, 0.0);
        slabs_per_unit_ = slabs_ / (middle + radius * unit - nearest_);
    }

    std::uint8_t slab(const glm::dvec3& point) const
    {
        const double slab = (of(point) - nearest_) * slabs_per_unit_;
        return slab >= slabs_ ? static_cast<std::uint8_t>(slabs_ - 1)
               : slab > 0     ? static_cast<std::uint8_t>(slab)
                              : std::uint8_t{0};
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
    std::uint8_t slabs_;
    double nearest_ = 0;
    double slabs_per_unit_ = 0;
};

} // namespace

BspXmpvo::BspXmpvo(const Scene& scene, std::uint64_t seed)
    : scene_(scene), tree_(scene, seed), boundary_cells_(tree_.faces(), scene.cell_count()), cover_search_(scene, tree_)
{
    if (!scene.is_surface())
        scene.overlap_planes();
}

void BspXmpvo::look_at_faces(const glm::dvec4& eye)
{
    const std::span<const CellFace> faces = tree_.faces();
    roles_.resize(faces.size());
    cells_.resize(boundary_cells_.count());
    slabs_.resize(boundary_cells_.count());
    for (std::vector<std::uint32_t>& deferred : deferred_)
        deferred.clear();
    const Depth depth(scene_.bounds(), eye, slab_count);
    const FaceCorners& corners = cover_search_.corners();
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<std::size_t>(0, boundary_cells_.count(), 1024), [&](const auto& range) {
            for (std::size_t cell = range.begin(); cell < range.end(); ++cell) {
                const auto [begin, end] = boundary_cells_.faces(cell);
                BoundaryCell of_cell{faces[begin].cell, begin, 0, 0, false, no_cell, no_cell, 0, 0};
                std::uint8_t slab_of_cell = no_slab;
                for (std::uint32_t i = begin; i < end; ++i) {
                    const std::uint8_t role = corners.has(i) ? role_of(i, eye) : std::uint8_t{0};
                    roles_[i] = role;
                    of_cell.entries |= static_cast<std::uint8_t>(((role & entry_role) != 0 ? 1u : 0u) << (i - begin));
                    if ((role & exit_role) == 0)
                        continue;
                    of_cell.exits |= static_cast<std::uint8_t>(1u << (i - begin));
                    const std::uint8_t slab = depth.slab(corners.points()[corners.of(i)[0]]);
                    slab_of_cell = slab_of_cell == no_slab ? slab : std::max(slab_of_cell, slab);
                }
                cells_[cell] = of_cell;
                slabs_[cell] = slab_of_cell;
            }
        });
    cover_search_.look_from(eye, roles_, ranks_);
    tentative_relations(scene_, eye, tentative_);
    relate_touching();
}

// Of each boundary cell, those that cover a face of it with one of theirs that touches it.
void BspXmpvo::relate_touching()
{
    touching_tests_ = {};
    listed_in_step_.clear();
    blocked_.assign(boundary_cells_.count(), not_ready);
    cover_search_.find_touching(touching_covers_, touching_tests_);
    for (const auto& part : touching_covers_)
        for (const CoverSearch::Cover& cover : part) {
            ++blocked_[boundary_cells_.of_face(cover.front)];
            ++cells_[boundary_cells_.of_face(cover.back)].front_end;
        }
    for (const Relation& relation : tentative_) {
        ++blocked_[boundary_cells_.of_cell(relation.front)];
        ++cells_[boundary_cells_.of_cell(relation.back)].front_end;
    }
    std::uint32_t count = 0;
    for (BoundaryCell& cell : cells_) {
        cell.front_begin = count;
        count += std::exchange(cell.front_end, count);
    }
    fronts_.resize(count);
    for (const auto& part : touching_covers_)
        for (const CoverSearch::Cover& cover : part)
            fronts_[cells_[boundary_cells_.of_face(cover.back)].front_end++] = boundary_cells_.of_face(cover.front);
    for (const Relation& relation : tentative_)
        fronts_[cells_[boundary_cells_.of_cell(relation.back)].front_end++] = boundary_cells_.of_cell(relation.front);
    relation_count_ = count;
}

void BspXmpvo::reset_pending()
{
    cover_search_.reset_pending();
    for (CoverSearch::Workspace& workspace : workspaces_)
        workspace.tests = {};
}

void BspXmpvo::walk(const glm::dvec4& eye)
{
    const std::size_t faces = tree_.faces().size();
    ranks_.assign(faces, {0xffff, 0});
    const std::size_t groups = std::max<std::size_t>(tree_.node_count(), 1);
    std::size_t group_count = 0;
    tree_.walk(eye, [&](std::span<const std::uint32_t> group) {
        const auto rank = static_cast<std::uint16_t>(group_count * 65536 / groups);
        for (std::uint32_t face : group) {
            ranks_[face].last = rank;
            ranks_[face].first = std::min(ranks_[face].first, rank);
        }
        ++group_count;
    });
}

std::uint8_t BspXmpvo::role_of(std::uint32_t face, const glm::dvec4& eye) const
{
    if (scene_.is_surface())
        return cover_search_.corners().seen(face, eye).turn == Sign::zero ? 0 : exit_role | entry_role;
    const CellFace& of_cell = tree_.faces()[face];
    const std::uint32_t exit = signs_.exit(of_cell.cell) >> of_cell.face & 1u;
    const std::uint32_t entry = signs_.entry(of_cell.cell) >> of_cell.face & 1u;
    return static_cast<std::uint8_t>(exit * exit_role | entry * entry_role);
}

template <int row, class State>
bool BspXmpvo::sort_by(LargeArray<State>& state, Order& order)
{
    const CellId cells = scene_.cell_count();
    state.resize(cells);
    resize_on_large_pages(order.back_to_front, cells);
    BspMerge<row, State> merge(*this, state.data(), order);
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
    const bool complete = scene_.is_surface()                  ? sort_by<0>(small_state_, order)
                          : scene_.adjacency().row_length == 4 ? sort_by<4>(small_state_, order)
                                                               : sort_by<6>(large_state_, order);
    if (!complete)
        sort_with_cycles(view.eye, order);
}

void BspXmpvo::sort_with_cycles(const glm::dvec4& eye, Order& order)
{
    boundary_relations(scene_, eye, all_relations_);
    if (scene_.is_surface())
        topological_sort_.run(scene_, all_relations_.relations, order);
    else
        topological_sort_.run(scene_, signs_, all_relations_.relations, tentative_, order);
    order.layer_begin.clear();
}

std::size_t BspXmpvo::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    const auto sum_of = [&](const auto& arrays) {
        return std::accumulate(arrays.begin(), arrays.end(), std::size_t{0},
                               [&](std::size_t sum, const auto& array) { return sum + size_of(array); });
    };
    const std::size_t of_workspaces =
        std::accumulate(workspaces_.begin(), workspaces_.end(), std::size_t{0},
                        [](std::size_t sum, const CoverSearch::Workspace& one) { return sum + one.bytes(); });
    return tree_.bytes() + boundary_cells_.bytes() + cover_search_.bytes() + signs_.bytes() + size_of(small_state_) +
           size_of(large_state_) + size_of(roles_) + size_of(ranks_) + size_of(cells_) + size_of(slabs_) +
           size_of(fronts_) + size_of(blocked_) + sum_of(deferred_) + size_of(looking_) + size_of(exits_) +
           size_of(covered_) + size_of(listed_in_step_) + size_of(queue_) + sum_of(touching_covers_) + of_workspaces +
           size_of(all_relations_.relations) + size_of(tentative_) + topological_sort_.bytes();
}

std::vector<Statistic> BspXmpvo::statistics() const
{
    const auto as_double = [](std::size_t count) { return static_cast<double>(count); };
    CoverSearch::Tests tests = touching_tests_;
    for (const CoverSearch::Workspace& workspace : workspaces_) {
        tests.all += workspace.tests.all;
        tests.exact += workspace.tests.exact;
    }
    return {{"nodes", as_double(tree_.node_count())}, {"splits", as_double(tree_.split_count())},
            {"depth", as_double(tree_.depth())},      {"pair tests", as_double(tests.all)},
            {"exact tests", as_double(tests.exact)},  {"relations", as_double(relation_count_)}};
}

} // namespace visorder::detail
