#include "mpvo/mpvo_nc.h"

#include "scene/error.h"
#include "scene/face_loop.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder {

namespace {

// A cell's state: before it is reached, its interior exit faces as bits; then one of these.
constexpr std::uint8_t open = 0x40; // on the path, or about to be
constexpr std::uint8_t done = 0x80; // listed
constexpr std::size_t prefetch_sources = 8;

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
            sum += (mesh.points[v] - planes.origin) * planes.scale;
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
    const FacePlanes& planes = scene_.face_planes();
    const std::vector<CellFace>& faces = scene_.boundary().faces;
    // The squared distance, |w| (|c|^2 - 2 c.e / w + |e|^2 / w^2), without its last term, which all have in common: it
    // neither overflows nor drowns the others for an eye far away, and along a direction the distance is left. With
    // centres and eye scaled into a cube of half-width 1 the rest is above -6, and 8 more makes its bits ascend with
    // it.
    glm::dvec3 eye(view.eye);
    double w = view.eye.w;
    const double before = 1 / std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z), std::abs(w)});
    eye = (eye * before - planes.origin * (w *= before)) * planes.scale;
    const double largest = std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z), std::abs(w)});
    const double scale = (w < 0 ? -1 : 1) / (largest > 0 ? largest : 1);
    eye *= scale;
    w *= scale;

    keys_.resize(faces.size());
    sources_.resize(faces.size());
    in_parallel(faces.size(), [&](std::size_t i) {
        const glm::dvec3 c(centres_[i]);
        const auto distance = static_cast<float>(w * glm::dot(c, c) - 2 * glm::dot(c, eye) + 8);
        const bool front_facing = (signs_.entry(faces[i].cell) >> faces[i].face & 1u) != 0;
        keys_[i] = front_facing ? ~std::bit_cast<std::uint32_t>(distance) : ~0u;
    });
    source_count_ = keys_.size() - static_cast<std::size_t>(std::count(keys_.begin(), keys_.end(), ~0u));
    radix_sort_.sort(keys_, owners_, sources_);
}

// Lists every cell after all those it obstructs, and returns whether one of them obstructs it in turn.
template <int row>
bool MpvoNc::list_depth_first()
{
    const CellId cells = scene_.cell_count();
    const CellId* const neighbour = scene_.adjacency().neighbour.data();
    // Local: a store of a byte may change anything that is not.
    std::uint8_t* const state = state_.data();
    std::uint64_t* const path = path_.data();
    CellId* listed = listed_.data();
    bool cycles = false;

    const auto row_of = [&](CellId cell) { return neighbour + std::size_t{cell} * row; };
    const auto traverse = [&](CellId source) {
        std::size_t depth = 0;
        CellId cell = source;
        std::uint32_t exits = state[cell];
        const CellId* across = row_of(cell);
        state[cell] = open;
        for (;;) {
            while (exits != 0) {
                const CellId next = across[std::countr_zero(exits)];
                exits &= exits - 1;
                const std::uint8_t s = state[next];
                if (s >= open) {
                    cycles |= s == open;
                    continue;
                }
                path[depth++] = std::uint64_t{cell} << 8 | exits;
                cell = next;
                exits = s;
                state[cell] = open;
                across = row_of(cell);
                for (int f = 0; f < row; ++f) {
                    __builtin_prefetch(state + across[f], 1);
                    __builtin_prefetch(row_of(across[f]));
                }
            }
            state[cell] = done;
            *listed++ = cell;
            if (depth == 0)
                return;
            const std::uint64_t back = path[--depth];
            cell = static_cast<CellId>(back >> 8);
            exits = back & 0xffu;
            across = row_of(cell);
        }
    };
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        if (i + prefetch_sources < sources_.size()) {
            __builtin_prefetch(state + sources_[i + prefetch_sources], 1);
            __builtin_prefetch(row_of(sources_[i + prefetch_sources]));
        }
        if (state[sources_[i]] < open)
            traverse(sources_[i]);
    }
    // Cells in front of all they meet that the eye sees edge-on, and cycles off the boundary.
    for (CellId cell = 0; cell < cells; ++cell)
        if (state[cell] < open)
            traverse(cell);
    return cycles;
}

void MpvoNc::sort(const View& view, Order& order)
{
    validate(view);
    signs_.evaluate(scene_, view.eye);
    sort_sources(view);
    const Adjacency& adjacency = scene_.adjacency();
    const CellId cells = scene_.cell_count();
    state_.resize(cells);
    path_.resize(cells);
    listed_.resize(cells);
    in_parallel(cells, [&](std::size_t i) {
        const auto cell = static_cast<CellId>(i);
        state_[i] = static_cast<std::uint8_t>(signs_.exit(cell) & adjacency.interior[i]);
    });
    const bool cycles = adjacency.row_length == 4 ? list_depth_first<4>() : list_depth_first<6>();

    order.layer_begin.clear();
    order.cycles.clear();
    resize_on_large_pages(order.back_to_front, cells);
    const std::span<const CellId> caller_cells = scene_.caller_cells();
    in_parallel(cells, [&](std::size_t i) { order.back_to_front[i] = caller_cells[listed_[i]]; });
    if (cycles) {
        topological_sort_.run(scene_, signs_, {}, order_of_cycles_);
        order.cycles = order_of_cycles_.cycles;
    }
}

std::size_t MpvoNc::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return size_of(owners_) + size_of(centres_) + signs_.bytes() + radix_sort_.bytes() + size_of(keys_) +
           size_of(sources_) + size_of(state_) + size_of(path_) + size_of(listed_) + topological_sort_.bytes() +
           size_of(order_of_cycles_.back_to_front);
}

std::vector<Statistic> MpvoNc::statistics() const
{
    return {{"sources", static_cast<double>(source_count_)}};
}

std::unique_ptr<Sorter> make_mpvo_nc(const Scene& scene, const SorterOptions&)
{
    return std::make_unique<MpvoNc>(scene);
}

} // namespace visorder
