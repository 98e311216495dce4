#include "visorder/checking.h"

#include "checking/convex_body.h"
#include "checking/order_positions.h"
#include "checking/planar_faces.h"
#include "checking/relation_set.h"
#include "geometry/exact_predicates.h"
#include "geometry/face_overlap.h"
#include "parallel/large_array.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "scene/face_planes.h"
#include "scene/seen_face.h"

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <span>
#include <stdexcept>

namespace visorder {

using namespace detail;

namespace {

using Pair = std::pair<CellId, CellId>;

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

// Where a ray that has passed through `front` enters `back`, rounded; of cells with a relation.
glm::dvec3 witness(const Scene& scene, const glm::dvec4& eye, CellId front, CellId back)
{
    const Mesh& mesh = scene.mesh();
    const auto faces_with_side = [&](CellId cell, Sign side) {
        std::vector<CellFace> faces;
        if (scene.is_surface())
            return std::vector<CellFace>{{cell, 0}};
        for (int face = 0; face < face_count(mesh.shapes[cell]); ++face)
            if (exact_face_side(scene, cell, face, eye) == side)
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
    if (!scene.is_surface())
        for (const CellFace& exit : exits)
            if (scene.adjacency().row(front)[exit.face] == back) {
                glm::dvec3 sum(0);
                const FaceLoop loop = face_loop(mesh, front, static_cast<int>(exit.face));
                for (PointId v : loop)
                    sum += mesh.points[v] / static_cast<double>(loop.count);
                return sum;
            }
    for (const CellFace& exit : exits)
        for (const CellFace& entry : faces_with_side(back, Sign::positive)) {
            const SeenFace f = seen_face(scene.mesh(), exit, eye), g = seen_face(scene.mesh(), entry, eye);
            const Overlap overlap = face_overlap(f, g, eye);
            if (overlap == Overlap::nearer || overlap == Overlap::coincident)
                return rounded_or_exact_point(f, g);
        }
    throw std::logic_error("a relation without faces that show it");
}

} // namespace

const glm::dvec4& Relations::eye() const
{
    return set_->eye();
}

std::size_t Relations::count() const
{
    return set_->count();
}

void Relations::visit(const std::function<void(CellId, CellId)>& visit) const
{
    set_->visit(visit);
}

OrderChecker::OrderChecker(const Scene& scene) : scene_(scene)
{
    require_planar_faces(scene);
}

Relations OrderChecker::relations_at(const glm::dvec4& eye) const
{
    validate(View{eye, glm::dmat4(1), glm::ivec2(1)});
    return Relations(std::make_shared<const RelationSet>(scene_, eye));
}

CheckResult OrderChecker::check(const Relations& relations, const Order& order, CheckOptions options) const
{
    const RelationSet& set = *relations.set_;
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
                set.visit_interior(range.begin(), range.end(), part);
                return part;
            },
            join);
        all.add(oneapi::tbb::parallel_reduce(
            oneapi::tbb::blocked_range<std::size_t>(0, set.boundary().size(), 16384), none,
            [&](const auto& range, Tally part) {
                for (std::size_t i = range.begin(); i < range.end(); ++i)
                    part(set.boundary()[i].front, set.boundary()[i].back);
                return part;
            },
            join));
        return all;
    };

    CheckResult result;
    result.relations = relations.count();
    result.overlapping = set.overlapping();
    // Only an order that leaves relations unsatisfied raises the question whether any does not.
    if (tally({}, 0).violations == 0) {
        set.an_order_is_known();
        return result;
    }
    const RelationSet::UnorderableSets& unorderable = set.unorderable();
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
                       : witness(scene_, relations.eye(), front, back)});
    }
    return result;
}

} // namespace visorder
