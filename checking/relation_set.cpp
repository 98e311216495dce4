#include "checking/relation_set.h"

#include "geometry/exact_predicates.h"
#include "scene/face_planes.h"
#include "sorting/boundary_relations.h"
#include "sorting/strongly_connected.h"

#include <algorithm>
#include <bit>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

std::pair<CellId, CellId> ascending(CellId a, CellId b)
{
    return {std::min(a, b), std::max(a, b)};
}

// The directed graph of the relations, and which of its cells are on no cycle because none occludes them but such
// cells.
class Peeling {
public:
    Peeling(CellId cells, const RelationSet& relations) : backs_begin_(std::size_t{cells} + 1), obstructing_(cells)
    {
        std::fill(backs_begin_.begin(), backs_begin_.end(), 0);
        std::fill(obstructing_.begin(), obstructing_.end(), 0);
        relations.visit([&](CellId front, CellId back) {
            ++backs_begin_[front];
            ++obstructing_[back];
        });
        std::size_t end = 0;
        for (std::size_t& count : backs_begin_)
            count = end += count;
        // Filled from each row's end, so that its counter comes to rest on its beginning.
        backs_.resize(end);
        relations.visit([&](CellId front, CellId back) { backs_[--backs_begin_[front]] = back; });
        peel(cells);
    }

    bool is_peeled(CellId cell) const { return obstructing_[cell] == 0; }
    std::span<const CellId> backs(CellId front) const
    {
        return {backs_.data() + backs_begin_[front], backs_.data() + backs_begin_[front + 1]};
    }

private:
    void peel(CellId cells)
    {
        LargeArray<CellId> free;
        free.reserve(cells);
        for (CellId cell = 0; cell < cells; ++cell)
            if (obstructing_[cell] == 0)
                free.push_back(cell);
        for (std::size_t next = 0; next < free.size(); ++next)
            for (CellId back : backs(free[next]))
                if (--obstructing_[back] == 0)
                    free.push_back(back);
    }

    LargeArray<std::size_t> backs_begin_;
    LargeArray<CellId> backs_;
    LargeArray<std::uint32_t> obstructing_; // how many that are not peeled
};

} // namespace

RelationSet::RelationSet(const Scene& scene, const glm::dvec4& eye)
    : scene_(scene), adjacency_(scene.is_surface() ? nullptr : &scene.adjacency()), eye_(eye)
{
    if (!scene.is_surface())
        evaluate_interior();
    evaluate_boundary();
}

void RelationSet::evaluate_interior()
{
    interior_.resize(scene_.cell_count());
    std::atomic<std::size_t> count{0};
    const auto exit_or_entry = [&](CellId cell, std::uint32_t face) -> std::uint32_t {
        const Sign side = exact_face_side(scene_, cell, static_cast<int>(face), eye_);
        return side == Sign::negative ? 1u << face : side == Sign::positive ? 1u << (face + 8) : 0u;
    };
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, scene_.cell_count(), 4096), [&](const auto& range) {
        std::size_t in_range = 0;
        for (CellId cell = range.begin(); cell < range.end(); ++cell) {
            const auto row = adjacency_->row(cell);
            std::uint32_t bits = 0;
            for (std::uint32_t face = 0; face < row.size(); ++face) {
                if (row[face] <= cell)
                    continue;
                std::uint32_t bit = exit_or_entry(cell, face);
                // Flat cells can share several faces with one neighbour; the relation is one all the same.
                for (std::uint32_t other = 0; other < face; ++other)
                    if (row[other] == row[face] && (bits >> other & 0x101u) == (bit >> face & 0x101u))
                        bit = 0;
                bits |= bit;
            }
            interior_[cell] = static_cast<std::uint16_t>(bits);
            in_range += static_cast<std::size_t>(std::popcount(bits));
        }
        count += in_range;
    });
    count_ += count;
}

void RelationSet::evaluate_boundary()
{
    BoundaryRelations found;
    boundary_relations(scene_, eye_, found);
    boundary_ = std::move(found.relations);
    count_ += boundary_.size();
    const auto caller = scene_.caller_cells();
    for (const auto& [a, b] : found.overlapping)
        overlapping_.push_back(ascending(caller[a], caller[b]));
    std::sort(overlapping_.begin(), overlapping_.end());
}

RelationSet::UnorderableSets RelationSet::find_unorderable() const
{
    const CellId cells = scene_.cell_count();
    const Peeling peeling(cells, *this);
    std::vector<CellId> left;
    for (CellId cell = 0; cell < cells; ++cell)
        if (!peeling.is_peeled(cell))
            left.push_back(cell);
    if (left.empty())
        return {};

    // What a cell that is left occludes is left too.
    LargeArray<std::uint32_t> node_of(cells);
    for (std::uint32_t node = 0; node < left.size(); ++node)
        node_of[left[node]] = node;
    std::vector<std::uint32_t> from, to;
    for (CellId front : left)
        for (CellId back : peeling.backs(front)) {
            from.push_back(node_of[front]);
            to.push_back(node_of[back]);
        }
    const Components components =
        strongly_connected_components(graph_of(static_cast<std::uint32_t>(left.size()), from, to));

    std::vector<std::vector<CellId>> members(components.count);
    for (std::uint32_t node = 0; node < left.size(); ++node)
        members[components.of_node[node]].push_back(left[node]);
    std::erase_if(members, [](const auto& set) { return set.size() < 2; });
    const auto caller = scene_.caller_cells();
    for (std::vector<CellId>& set : members) {
        for (CellId& cell : set)
            cell = caller[cell];
        std::sort(set.begin(), set.end());
    }
    std::sort(members.begin(), members.end());
    return {std::move(members), {}};
}

// What cycle_crossings.h needs to know of the sets.
void RelationSet::find_neighbours(UnorderableSets& unorderable) const
{
    SetsAndNeighbours& known = unorderable.known;
    const auto caller = scene_.caller_cells();
    std::vector<std::uint32_t> set_of_caller(scene_.cell_count(), 0);
    for (std::uint32_t i = 0; i < unorderable.sets.size(); ++i)
        for (CellId cell : unorderable.sets[i])
            set_of_caller[cell] = i + 1;
    known.set_of.resize(scene_.cell_count());
    known.sets.resize(unorderable.sets.size());
    for (CellId cell = 0; cell < scene_.cell_count(); ++cell) {
        known.set_of[cell] = set_of_caller[caller[cell]];
        if (known.set_of[cell] != 0)
            known.sets[known.set_of[cell] - 1].push_back(cell);
    }
    visit([&](CellId front, CellId back) {
        if (known.set_of[front] != known.set_of[back])
            known.relations.push_back({front, back});
    });
    std::sort(known.relations.begin(), known.relations.end());
}

const RelationSet::UnorderableSets& RelationSet::unorderable() const
{
    return unorderable_.get([&] {
        if (an_order_is_known_)
            return UnorderableSets{};
        UnorderableSets found = find_unorderable();
        if (!found.sets.empty())
            find_neighbours(found);
        return found;
    });
}

} // namespace visorder::detail
