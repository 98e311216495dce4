#include "bsp/bsp_xmpvo.h"

#include "scene/face_overlap.h"
#include "sorting/registry.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <utility>

namespace visorder {

namespace {

constexpr std::uint8_t exit_role = 1;
constexpr std::uint8_t entry_role = 2;
constexpr std::uint32_t none = 0xffffffffu;
constexpr std::uint16_t slab_count = 64; // of the scene's depth
constexpr std::uint16_t no_slab = slab_count;
constexpr std::size_t prefetch_rows = 32;
constexpr std::size_t prefetch_states = 12;

// How far from the eye points are, in slabs of the scene's depth: a guess at the order, no decision.
class Depth {
public:
    Depth(const Box& bounds, const glm::dvec4& eye) : eye_(eye)
    {
        const glm::dvec3 half = bounds.max * 0.5 - bounds.min * 0.5;
        const double radius = std::sqrt(glm::dot(half, half));
        const double middle = of(bounds.middle());
        const double unit = eye.w == 0 ? std::sqrt(glm::dot(glm::dvec3(eye), glm::dvec3(eye))) : 1.0;
        nearest_ = eye.w == 0 ? middle - radius * unit : std::max(middle - radius, 0.0);
        slabs_per_unit_ = slab_count / (middle + radius * unit - nearest_);
    }

    std::uint16_t slab(const glm::dvec3& point) const
    {
        const double slab = (of(point) - nearest_) * slabs_per_unit_;
        return slab >= slab_count ? slab_count - 1 : slab > 0 ? static_cast<std::uint16_t>(slab) : std::uint16_t{0};
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

// One frame. A cell's state holds, in the lowest `row` bits, its interior entry faces; then one bit if it has boundary
// faces in the tree; above, behind how many of its interior exit faces the cell is not listed. At zero it is ready, and
// waits in the queue to be listed.
template <int row, class State>
class BspMerge {
public:
    BspMerge(BspXmpvo& sorter, State* state, const glm::dvec4& eye, Order& order)
        : sorter_(sorter),
          eye_(eye),
          state_(state),
          neighbour_(row > 0 ? sorter.scene_.adjacency().neighbour.data() : nullptr),
          caller_cells_(sorter.scene_.caller_cells().data()),
          order_(order.back_to_front.data())
    {
    }

    // Returns how many cells were listed.
    std::size_t run()
    {
        count();
        list();
        return listed_;
    }

private:
    static constexpr State at_boundary = State{1} << row;
    static constexpr State one = State{2} << row;

    static bool ready(State s) { return s < one; }
    CellId owner(std::uint32_t face) const { return sorter_.tree_.faces()[face].cell; }

    void count()
    {
        const CellId cells = sorter_.scene_.cell_count();
        if constexpr (row > 0) {
            const Adjacency& adjacency = sorter_.scene_.adjacency();
            const FaceSigns& signs = sorter_.signs_;
            oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, cells, 16384), [&](const auto& range) {
                for (CellId cell = range.begin(); cell < range.end(); ++cell) {
                    const std::uint32_t interior = adjacency.interior[cell];
                    const std::uint32_t obstructed = bits_set[signs.exit(cell) & interior];
                    state_[cell] = static_cast<State>((signs.entry(cell) & interior) | obstructed * one);
                }
            });
        } else {
            std::fill_n(state_, cells, State{0});
        }
        for (std::size_t i = 0; i < sorter_.boundary_cells_.count(); ++i) {
            State& state = state_[owner(sorter_.boundary_cells_.faces(i).first)];
            state = static_cast<State>(state | at_boundary);
        }
        // A boundary cell can be there twice: when it is ready, and when it may be listed.
        sorter_.queue_.resize(cells + sorter_.boundary_cells_.count() + 1);
        CellId* const queue = sorter_.queue_.data();
        for (CellId cell = 0; cell < cells; ++cell) {
            if (cell + 8 <= cells && none_of_eight_ready(state_ + cell)) {
                cell += 7;
                continue;
            }
            queue[ready_] = cell;
            ready_ += ready(state_[cell]);
        }
    }

    // Few cells are ready at first: states of one byte are passed over eight at a time.
    static bool none_of_eight_ready(const State* states)
    {
        if constexpr (sizeof(State) > 1 || row == 0) {
            return false;
        } else {
            std::uint64_t eight;
            std::memcpy(&eight, states, sizeof eight);
            // The counts, three bits each: none is zero if adding 7 to every one carries out of all of them.
            const std::uint64_t counts = eight >> (row + 1) & 0x0707070707070707u;
            return ((counts + 0x0707070707070707u) & 0x0808080808080808u) == 0x0808080808080808u;
        }
    }

    bool is_listed(std::uint32_t boundary_cell) const { return sorter_.is_listed_[boundary_cell] != 0; }

    // Lists the cells that are ready, and those that become so: cells with boundary exit faces last and farthest first,
    // when most of what they may cover has been listed.
    void list()
    {
        list_queue();
        while (farthest_ > 0) {
            std::uint32_t boundary_cell = std::exchange(sorter_.deferred_[farthest_ - 1], none);
            if (boundary_cell == none) {
                --farthest_;
                continue;
            }
            while (boundary_cell != none) {
                const std::uint32_t next = sorter_.next_[boundary_cell];
                look_for_covered(boundary_cell);
                boundary_cell = next;
            }
            list_queue();
        }
    }

    void defer(std::uint32_t boundary_cell)
    {
        const std::uint32_t slab = sorter_.slabs_[boundary_cell];
        sorter_.next_[boundary_cell] = std::exchange(sorter_.deferred_[slab], boundary_cell);
        farthest_ = std::max<std::size_t>(farthest_, slab + 1);
    }

    void list_queue()
    {
        // Held in local variables: the compiler takes a store of a byte to change anything that is not local.
        State* const state = state_;
        const CellId* const neighbour = neighbour_;
        CellId* const queue = sorter_.queue_.data();
        std::size_t ready_end = ready_;
        for (std::size_t at = queue_begin_; at < ready_end; ++at) {
            if (at + prefetch_rows < ready_end) {
                const CellId ahead = queue[at + prefetch_rows];
                __builtin_prefetch(caller_cells_ + ahead);
                if constexpr (row > 0) {
                    __builtin_prefetch(neighbour + std::size_t{ahead} * row);
                    const CellId* soon = neighbour + std::size_t{queue[at + prefetch_states]} * row;
                    for (int f = 0; f < row; ++f)
                        __builtin_prefetch(state + soon[f], 1);
                }
            } else if constexpr (row > 0) {
                // What is to come is not known yet; it is one of these.
                const CellId* across = neighbour + std::size_t{queue[at]} * row;
                for (int f = 0; f < row; ++f)
                    __builtin_prefetch(neighbour + std::size_t{across[f]} * row);
            }
            const CellId cell = queue[at];
            const State s = state[cell];
            if ((s & at_boundary) != 0 && !come_to_boundary_cell(cell))
                continue;
            order_[listed_++] = caller_cells_[cell];
            if constexpr (row > 0) {
                const CellId* across = neighbour + std::size_t{cell} * row;
                for (int f = 0; f < row; ++f) {
                    const auto holds = static_cast<State>(s >> f & 1u);
                    const auto left = static_cast<State>(state[across[f]] - holds * one);
                    state[across[f]] = left;
                    queue[ready_end] = across[f];
                    ready_end += holds & static_cast<State>(ready(left));
                }
            }
        }
        queue_begin_ = ready_ = ready_end;
    }

    // Whether a ready boundary cell is to be listed now: if it has no exit face there, or covers nothing any more.
    bool come_to_boundary_cell(CellId cell)
    {
        const auto boundary_cell = static_cast<std::uint32_t>(sorter_.boundary_cells_.of_cell(cell));
        if (is_listed(boundary_cell))
            return true;
        if (sorter_.slabs_[boundary_cell] != no_slab) {
            defer(boundary_cell);
            return false;
        }
        list_boundary_cell(boundary_cell);
        return true;
    }

    // What waited for the cell looks again for what it covers.
    void list_boundary_cell(std::uint32_t boundary_cell)
    {
        sorter_.is_listed_[boundary_cell] = 1;
        const auto [begin, end] = sorter_.boundary_cells_.faces(boundary_cell);
        for (std::uint32_t face = begin; face < end; ++face)
            sorter_.pending_.remove(face);
        std::uint32_t waiting = std::exchange(sorter_.waiting_head_[boundary_cell], none);
        while (waiting != none) {
            const std::uint32_t next = sorter_.next_[waiting];
            defer(waiting);
            waiting = next;
        }
    }

    // A ready cell that covers no pending face goes back to the queue to be listed; else it waits for the cell of one
    // that it covers: a near one, which is likely to be listed last.
    void look_for_covered(std::uint32_t boundary_cell)
    {
        const auto [begin, end] = sorter_.boundary_cells_.faces(boundary_cell);
        std::uint32_t covered = none;
        for (std::uint32_t face = begin; face < end && covered == none; ++face)
            if ((sorter_.roles_[face] & exit_role) != 0)
                sorter_.pending_.search(
                    face, [&](std::uint32_t entry) { sorter_.heights_.prefetch(entry); },
                    [&](std::uint32_t entry) {
                        if (sorter_.obstructs(face, entry, eye_))
                            covered = entry;
                        return covered == none;
                    });
        if (covered != none) {
            ++sorter_.relation_count_;
            std::uint32_t& head = sorter_.waiting_head_[sorter_.boundary_cells_.of_face(covered)];
            sorter_.next_[boundary_cell] = std::exchange(head, boundary_cell);
            return;
        }
        list_boundary_cell(boundary_cell);
        sorter_.queue_[ready_++] = owner(begin);
    }

    BspXmpvo& sorter_;
    const glm::dvec4& eye_;
    State* state_;
    const CellId* neighbour_;
    const CellId* caller_cells_;
    CellId* order_;
    std::size_t queue_begin_ = 0;
    std::size_t ready_ = 0;
    std::size_t listed_ = 0;
    std::size_t farthest_ = 0; // one more than the farthest slab that may hold deferred cells
};

BoundaryCells::BoundaryCells(std::span<const CellFace> faces, CellId cells)
    : bits_((std::size_t{cells} + 63) / 64), before_(bits_.size())
{
    for (std::uint32_t face = 0; face < faces.size(); ++face) {
        const CellId cell = faces[face].cell;
        if (face == 0 || faces[face - 1].cell != cell)
            first_face_.push_back(face);
        of_face_.push_back(static_cast<std::uint32_t>(first_face_.size() - 1));
        bits_[cell / 64] |= std::uint64_t{1} << cell % 64;
    }
    first_face_.push_back(static_cast<std::uint32_t>(faces.size()));
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < bits_.size(); ++i) {
        before_[i] = before;
        before += static_cast<std::uint32_t>(std::popcount(bits_[i]));
    }
}

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
    waiting_head_.assign(boundary_cells_.count(), none);
    next_.resize(boundary_cells_.count());
    slabs_.resize(boundary_cells_.count());
    deferred_.assign(slab_count, none);
    boxes_.reset(faces.size(), charts.count());
    const Depth depth(scene_.bounds(), eye);
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
    pending_.reset(boxes_, ranks_, [&](std::uint32_t face) { return (roles_[face] & entry_role) != 0; });
    test_count_ = exact_test_count_ = relation_count_ = 0;
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

bool BspXmpvo::obstructs(std::uint32_t f, std::uint32_t g, const glm::dvec4& eye)
{
    ++test_count_;
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
    if (!(nearer == Sure::yes && shared == Shared::area) && !covers_exactly(f, g, eye))
        return false;
    const auto& overlapping = scene_.overlapping_cells();
    const std::pair<CellId, CellId> pair = std::minmax(front, back);
    return !std::binary_search(overlapping.begin(), overlapping.end(), pair);
}

bool BspXmpvo::covers_exactly(std::uint32_t f, std::uint32_t g, const glm::dvec4& eye)
{
    const SeenFace front = corners_.seen(f, eye), back = corners_.seen(g, eye);
    if (surely_not_nearer(front, back))
        return false;
    ++exact_test_count_;
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
           size_of(slabs_) + size_of(deferred_) + boxes_.bytes() + pending_.bytes() +
           size_of(all_relations_.relations) + topological_sort_.bytes();
}

std::vector<Statistic> BspXmpvo::statistics() const
{
    const auto as_double = [](std::size_t count) { return static_cast<double>(count); };
    return {{"nodes", as_double(tree_.node_count())},      {"splits", as_double(tree_.split_count())},
            {"depth", as_double(tree_.depth())},           {"pair tests", as_double(test_count_)},
            {"exact tests", as_double(exact_test_count_)}, {"relations", as_double(relation_count_)}};
}

std::unique_ptr<Sorter> make_bsp_xmpvo(const Scene& scene, const SorterOptions& options)
{
    return std::make_unique<BspXmpvo>(scene, options.bsp_seed);
}

} // namespace visorder
