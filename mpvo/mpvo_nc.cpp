#include "mpvo/mpvo_nc.h"

#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "scene/face_set.h"
#include "visorder/error.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

constexpr std::size_t prefetch_sources = 8; // their neighbours; they themselves twice as far ahead

template <class Body>
void in_parallel(std::size_t count, const Body& body)
{
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, 16384), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            body(i);
    });
}

} // namespace

MpvoNc::MpvoNc(const Scene& scene) : scene_(scene)
{
    if (scene.is_surface())
        throw InputError("mpvo-nc orders solid cells; the triangles of a surface share no faces");
    const FacePlanes& planes = scene.face_planes();
    const Mesh& mesh = scene.mesh();
    for (const CellFace& face : scene.boundary().faces) {
        glm::dvec3 sum(0);
        const FaceLoop loop = face_loop(mesh, face.cell, static_cast<int>(face.face));
        for (PointId v : loop)
            sum += planes.frame.unit(mesh.points[v]);
        centres_.emplace_back(sum / static_cast<double>(loop.count));
        owners_.push_back(face.cell);
    }
}

Guarantee MpvoNc::guarantee() const
{
    return scene_.traits().convex ? Guarantee::exact : Guarantee::approximate;
}

void MpvoNc::sort_sources(const View& view)
{
    const std::vector<CellFace>& faces = scene_.boundary().faces;
    // The squared distance, times w: w |c|^2 - 2 c.e + |e|^2 / w, without its last term, which all have in common. What
    // is left neither overflows nor drowns for an eye far away, and along a direction it is the distance. With centres
    // in a cube of half-width 1, and e not above 2, it is above -12; 16 more makes its bits ascend with it.
    const glm::dvec4 unit = unit_eye(scene_.face_planes().frame, view.eye);
    const glm::dvec3 eye(unit);

    keys_.resize(faces.size());
    sources_.resize(faces.size());
    in_parallel(faces.size(), [&](std::size_t i) {
        const glm::dvec3 c(centres_[i]);
        const auto distance = static_cast<float>(unit.w * glm::dot(c, c) - 2 * glm::dot(c, eye) + 16);
        const bool front_facing = (signs_.entry(faces[i].cell) >> faces[i].face & 1u) != 0;
        keys_[i] = front_facing ? ~std::bit_cast<std::uint32_t>(distance) : ~0u;
    });
    source_count_ = keys_.size() - static_cast<std::size_t>(std::count(keys_.begin(), keys_.end(), ~0u));
    radix_sort_.sort(keys_, owners_, sources_);
}

// The turn of a source lists what it occludes and no farther source does. So the sets of all turns, last first, are
// what comes free when the boundary's front-facing faces are taken away nearest first, and the entry faces of a cell
// with the cell before them: it is free with its last entry face. Within a turn, cells are taken first come, first
// served, without branches on sides or counts, which a walk down and up again would guess wrong at every other face.
//
// A cell's state holds its interior exit faces in the lowest `row` bits, and above them how many entry faces are left.
template <int row, class State>
std::size_t MpvoNc::list(State* const state)
{
    constexpr State one = State{1} << row;
    const CellId cells = scene_.cell_count();
    const CellId* const neighbour = scene_.adjacency().neighbour.data();
    CellId* const listed = listed_.data();
    std::size_t begin = 0, end = 0;
    const auto row_of = [&](CellId cell) { return neighbour + std::size_t{cell} * row; };
    const auto list_what_is_free = [&] {
        for (; begin < end; ++begin) {
            const CellId cell = listed[begin];
            const State exits = state[cell];
            const CellId* const across = row_of(cell);
            for (int f = 0; f < row; ++f) {
                const CellId behind = across[f];
                const auto exit = static_cast<State>(exits >> f & 1u);
                const auto left = static_cast<State>(state[behind] - (exit << row));
                state[behind] = left;
                listed[end] = behind;
                end += static_cast<std::size_t>(left < one) & exit;
                __builtin_prefetch(row_of(behind));
            }
        }
    };

    // In front of all they meet, and no face of theirs in front: seen edge-on.
    for (CellId cell = 0; cell < cells; ++cell)
        if (state[cell] < one)
            listed[end++] = cell;
    list_what_is_free();
    for (std::size_t i = source_count_; i-- > 0;) {
        if (i >= 2 * prefetch_sources) {
            __builtin_prefetch(state + sources_[i - 2 * prefetch_sources], 1);
            __builtin_prefetch(row_of(sources_[i - 2 * prefetch_sources]));
            const CellId* const soon = row_of(sources_[i - prefetch_sources]);
            for (int f = 0; f < row; ++f) {
                __builtin_prefetch(state + soon[f], 1);
                __builtin_prefetch(row_of(soon[f]));
            }
        }
        const CellId source = sources_[i];
        state[source] = static_cast<State>(state[source] - one);
        if (state[source] < one) {
            listed[end++] = source;
            list_what_is_free();
        }
    }
    return end;
}

template <int row, class State>
void MpvoNc::count_entry_faces(State* state)
{
    const Adjacency& adjacency = scene_.adjacency();
    in_parallel(scene_.cell_count(), [&](std::size_t i) {
        const auto cell = static_cast<CellId>(i);
        const std::uint32_t interior = adjacency.interior[i];
        state[i] = static_cast<State>((signs_.exit(cell) & interior) |
                                      std::uint32_t{bits_set[signs_.entry(cell) & interior]} << row);
    });
    for (std::size_t i = 0; i < source_count_; ++i)
        state[sources_[i]] = static_cast<State>(state[sources_[i]] + (1u << row));
}

// Takes the relations that an order does not satisfy out of the states: the others run in no circle.
template <int row, class State>
void MpvoNc::cut_cycles(State* state, const Order& order) const
{
    const std::span<const CellId> caller_cells = scene_.caller_cells();
    std::vector<std::uint32_t> position(scene_.cell_count()); // by the caller's number
    for (std::size_t i = 0; i < position.size(); ++i)
        position[order.back_to_front[i]] = static_cast<std::uint32_t>(i);
    const Adjacency& adjacency = scene_.adjacency();
    in_parallel(position.size(), [&](std::size_t i) {
        const auto cell = static_cast<CellId>(i);
        const std::span<const CellId> across = adjacency.row(cell);
        for (std::size_t f = 0; f < row; ++f) {
            const bool is_nearer = position[caller_cells[cell]] > position[caller_cells[across[f]]];
            const std::uint32_t bit = 1u << f & adjacency.interior[i];
            if (is_nearer && (signs_.entry(cell) & bit) != 0)
                state[i] = static_cast<State>(state[i] - (1u << row));
            if (!is_nearer && (signs_.exit(cell) & bit) != 0)
                state[i] = static_cast<State>(state[i] & ~bit);
        }
    });
}

template <int row, class State>
void MpvoNc::sort_by(LargeArray<State>& state, Order& order)
{
    const CellId cells = scene_.cell_count();
    state.resize(cells);
    listed_.resize(std::size_t{cells} + 1); // one to write what is not free to
    order.cycles.clear();
    count_entry_faces<row>(state.data());
    if (list<row>(state.data()) == cells)
        return;
    topological_sort_.run(scene_, signs_, {}, order_of_cycles_);
    order.cycles = order_of_cycles_.cycles;
    count_entry_faces<row>(state.data());
    cut_cycles<row>(state.data(), order_of_cycles_);
    list<row>(state.data());
}

void MpvoNc::sort(const View& view, Order& order)
{
    validate(view);
    signs_.evaluate(scene_, view.eye);
    sort_sources(view);
    if (scene_.adjacency().row_length == 4)
        sort_by<4>(small_state_, order);
    else
        sort_by<6>(large_state_, order);

    const CellId cells = scene_.cell_count();
    order.layer_begin.clear();
    resize_on_large_pages(order.back_to_front, cells);
    const std::span<const CellId> caller_cells = scene_.caller_cells();
    in_parallel(cells, [&](std::size_t i) { order.back_to_front[cells - 1 - i] = caller_cells[listed_[i]]; });
}

std::size_t MpvoNc::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return size_of(owners_) + size_of(centres_) + signs_.bytes() + radix_sort_.bytes() + size_of(keys_) +
           size_of(sources_) + size_of(small_state_) + size_of(large_state_) + size_of(listed_) +
           topological_sort_.bytes() + size_of(order_of_cycles_.back_to_front);
}

std::vector<Statistic> MpvoNc::statistics() const
{
    return {{"sources", static_cast<double>(source_count_)}};
}

} // namespace visorder::detail
