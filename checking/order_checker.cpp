#include "checking/order_checker.h"

#include "checking/convex_body.h"
#include "checking/order_positions.h"
#include "checking/planar_faces.h"
#include "scene/face_loop.h"
#include "scene/face_overlap.h"
#include "sorting/boundary_relations.h"
#include "sorting/strongly_connected.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <span>
#include <stdexcept>

namespace visorder {

namespace {

using Pair = std::pair<CellId, CellId>;

template <class Body>
void each_cell(const Scene& scene, const Body& body)
{
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, scene.cell_count(), 4096), [&](const auto& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell)
            body(cell);
    });
}

Pair ascending(CellId a, CellId b)
{
    return {std::min(a, b), std::max(a, b)};
}

// The directed graph of the relations, and which of its cells are on no cycle because none obstructs them but such
// cells.
class Peeling {
public:
    Peeling(CellId cells, const Relations& relations) : backs_begin_(std::size_t{cells} + 1), obstructing_(cells)
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

// Counts the relations that an order does not satisfy and keeps the first of them.
class Tally {
public:
    Tally(const Scene& scene, std::span<const std::uint32_t> positions, std::span<const std::uint32_t> set_of,
          std::size_t most)
        : caller_(scene.caller_cells()), positions_(positions), set_of_(set_of), most_(most)
    {
    }

    void operator()(CellId front, CellId back)
    {
        if (positions_[front] > positions_[back]) [[likely]]
            return;
        if (!set_of_.empty() && set_of_[front] != 0 && set_of_[front] == set_of_[back]) {
            ++in_cycles;
            return;
        }
        ++violations;
        keep({{caller_[front], caller_[back]}, {front, back}});
    }

    void add(const Tally& other)
    {
        violations += other.violations;
        in_cycles += other.in_cycles;
        for (const Kept& kept : other.first_)
            keep(kept);
    }

    std::size_t violations = 0;
    std::size_t in_cycles = 0;

    // In the inner numbering, in the order of the caller's.
    std::vector<Pair> first()
    {
        std::sort(first_.begin(), first_.end());
        std::vector<Pair> pairs;
        for (const Kept& kept : first_)
            pairs.push_back(kept.inner);
        return pairs;
    }

private:
    struct Kept {
        Pair caller;
        Pair inner;
        bool operator<(const Kept& other) const { return caller < other.caller; }
    };

    // A heap, the last of those kept on top.
    void keep(const Kept& found)
    {
        if (first_.size() == most_) {
            if (most_ == 0 || !(found < first_.front()))
                return;
            std::pop_heap(first_.begin(), first_.end());
            first_.pop_back();
        }
        first_.push_back(found);
        std::push_heap(first_.begin(), first_.end());
    }

    std::span<const CellId> caller_;
    std::span<const std::uint32_t> positions_;
    std::span<const std::uint32_t> set_of_;
    std::size_t most_;
    std::vector<Kept> first_;
};

} // namespace

Relations::Relations(const Scene& scene, const glm::dvec4& eye)
    : scene_(&scene),
      adjacency_(scene.is_surface() ? nullptr : &scene.adjacency()),
      eye_(eye),
      on_demand_(std::make_unique<OnDemand>())
{
    if (!scene.is_surface())
        evaluate_interior();
    evaluate_boundary();
}

void Relations::evaluate_interior()
{
    interior_.resize(scene_->cell_count());
    std::atomic<std::size_t> count{0};
    const auto exit_or_entry = [&](CellId cell, std::uint32_t face) -> std::uint32_t {
        const Sign side = exact_face_side(*scene_, cell, static_cast<int>(face), eye_);
        return side == Sign::negative ? 1u << face : side == Sign::positive ? 1u << (face + 8) : 0u;
    };
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<CellId>(0, scene_->cell_count(), 4096), [&](const auto& range) {
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

void Relations::evaluate_boundary()
{
    BoundaryRelations found;
    boundary_relations(*scene_, eye_, found);
    boundary_ = std::move(found.relations);
    count_ += boundary_.size();
    const auto caller = scene_->caller_cells();
    for (const auto& [a, b] : found.overlapping)
        overlapping_.push_back(ascending(caller[a], caller[b]));
    std::sort(overlapping_.begin(), overlapping_.end());
}

Relations::UnorderableSets Relations::find_unorderable() const
{
    const CellId cells = scene_->cell_count();
    const Peeling peeling(cells, *this);
    std::vector<CellId> left;
    for (CellId cell = 0; cell < cells; ++cell)
        if (!peeling.is_peeled(cell))
            left.push_back(cell);
    if (left.empty())
        return {};

    // What a cell that is left obstructs is left too.
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
    const auto caller = scene_->caller_cells();
    for (std::vector<CellId>& set : members) {
        for (CellId& cell : set)
            cell = caller[cell];
        std::sort(set.begin(), set.end());
    }
    std::sort(members.begin(), members.end());
    return {std::move(members), {}};
}

// What cycle_crossings.h needs to know of the sets.
void Relations::find_neighbours(UnorderableSets& unorderable) const
{
    SetsAndNeighbours& known = unorderable.known;
    const auto caller = scene_->caller_cells();
    std::vector<std::uint32_t> set_of_caller(scene_->cell_count(), 0);
    for (std::uint32_t i = 0; i < unorderable.sets.size(); ++i)
        for (CellId cell : unorderable.sets[i])
            set_of_caller[cell] = i + 1;
    known.set_of.resize(scene_->cell_count());
    known.sets.resize(unorderable.sets.size());
    for (CellId cell = 0; cell < scene_->cell_count(); ++cell) {
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

const Relations::UnorderableSets& Relations::unorderable() const
{
    return on_demand_->unorderable.get([&] {
        if (on_demand_->an_order_is_known)
            return UnorderableSets{};
        UnorderableSets found = find_unorderable();
        if (!found.sets.empty())
            find_neighbours(found);
        return found;
    });
}

OrderChecker::OrderChecker(const Scene& scene) : scene_(scene)
{
    require_planar_faces(scene);
}

Relations OrderChecker::relations_at(const glm::dvec4& eye) const
{
    validate(View{eye, glm::dmat4(1), glm::ivec2(1)});
    return Relations(scene_, eye);
}

CheckResult OrderChecker::check(const Relations& relations, const Order& order, CheckOptions options) const
{
    const LargeArray<std::uint32_t> place = order_positions(scene_, order);
    const auto tally = [&](std::span<const std::uint32_t> set_of, std::size_t most) {
        const auto join = [](Tally a, const Tally& b) {
            a.add(b);
            return a;
        };
        const Tally none(scene_, place, set_of, most);
        Tally all = oneapi::tbb::parallel_reduce(
            oneapi::tbb::blocked_range<CellId>(0, scene_.cell_count(), 16384), none,
            [&](const auto& range, Tally part) {
                relations.visit_interior(range.begin(), range.end(), part);
                return part;
            },
            join);
        all.add(oneapi::tbb::parallel_reduce(
            oneapi::tbb::blocked_range<std::size_t>(0, relations.boundary_.size(), 16384), none,
            [&](const auto& range, Tally part) {
                for (std::size_t i = range.begin(); i < range.end(); ++i)
                    part(relations.boundary_[i].front, relations.boundary_[i].back);
                return part;
            },
            join));
        return all;
    };

    CheckResult result;
    result.relations = relations.count();
    result.overlapping = relations.overlapping_;
    // Only an order that leaves relations unsatisfied raises the question whether any does not.
    if (tally({}, 0).violations == 0) {
        relations.on_demand_->an_order_is_known = true;
        return result;
    }
    const Relations::UnorderableSets& unorderable = relations.unorderable();
    Tally found = tally(unorderable.known.set_of, options.max_witnesses);
    result.violations_in_cycles = found.in_cycles;
    result.unorderable = unorderable.sets;
    const std::vector<Relation> across = violations_across_sets(scene_, relations.eye(), unorderable.known, place);
    result.violations_across_cycles = across.size();
    for (const Relation& relation : across)
        found(relation.front, relation.back);
    result.violations = found.violations;
    for (const auto& [front, back] : found.first()) {
        const bool is_across = std::binary_search(across.begin(), across.end(), Relation{front, back});
        result.witnesses.push_back(
            {scene_.caller_cells()[front], scene_.caller_cells()[back],
             is_across ? occlusion_witness(body_of(scene_.mesh(), front), body_of(scene_.mesh(), back), relations.eye())
                       : witness(relations, front, back)});
    }
    return result;
}

glm::dvec3 OrderChecker::witness(const Relations& relations, CellId front, CellId back) const
{
    const Mesh& mesh = scene_.mesh();
    const glm::dvec4& eye = relations.eye();
    const auto faces_with_side = [&](CellId cell, Sign side) {
        std::vector<CellFace> faces;
        if (scene_.is_surface())
            return std::vector<CellFace>{{cell, 0}};
        for (int face = 0; face < face_count(mesh.shapes[cell]); ++face)
            if (exact_face_side(scene_, cell, face, eye) == side)
                faces.push_back({cell, static_cast<std::uint32_t>(face)});
        return faces;
    };
    // Coordinates may be so large that doubles do not hold what the rounded point is computed from.
    const auto rounded_or_exact_point = [&](const SeenFace& exit, const SeenFace& entry) {
        const glm::dvec3 point = common_point(exit, entry, eye);
        if (std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z))
            return point;
        return occlusion_witness(body_of(mesh, front), body_of(mesh, back), eye);
    };
    const std::vector<CellFace> exits = faces_with_side(front, Sign::negative);
    if (!scene_.is_surface())
        for (const CellFace& exit : exits)
            if (scene_.adjacency().row(front)[exit.face] == back) {
                glm::dvec3 sum(0);
                const FaceLoop loop = face_loop(mesh, front, static_cast<int>(exit.face));
                for (PointId v : loop)
                    sum += mesh.points[v] / static_cast<double>(loop.count);
                return sum;
            }
    for (const CellFace& exit : exits)
        for (const CellFace& entry : faces_with_side(back, Sign::positive)) {
            const SeenFace f = seen_face(scene_.mesh(), exit, eye), g = seen_face(scene_.mesh(), entry, eye);
            const Overlap overlap = face_overlap(f, g, eye);
            if (overlap == Overlap::nearer || overlap == Overlap::coincident)
                return rounded_or_exact_point(f, g);
        }
    throw std::logic_error("a relation without faces that show it");
}

} // namespace visorder
