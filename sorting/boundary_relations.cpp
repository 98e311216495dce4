#include "sorting/boundary_relations.h"

#include "geometry/box_hierarchy.h"
#include "geometry/exact_predicates.h"
#include "geometry/face_overlap.h"
#include "geometry/projection_charts.h"
#include "scene/adjacency.h"
#include "scene/face_planes.h"
#include "scene/seen_face.h"
#include "visorder/scene.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>
#include <span>
#include <tuple>

namespace visorder::detail {

namespace {

struct BoundaryFace {
    SeenFace seen;
    CellFace owner;
};

struct ExitsAndEntries {
    std::vector<BoundaryFace> exits;
    std::vector<BoundaryFace> entries;
};

template <class Body>
void in_parallel(std::size_t count, std::size_t grain, const Body& body)
{
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            body(i);
    });
}

ExitsAndEntries boundary_of_solids(const Scene& scene, const glm::dvec4& eye)
{
    const std::vector<CellFace>& faces = scene.relation_faces();
    std::vector<Sign> sides(faces.size());
    in_parallel(faces.size(), 1024, [&](std::size_t i) {
        sides[i] = exact_face_side(scene, faces[i].cell, static_cast<int>(faces[i].face), eye);
    });
    const auto with_side = [&](Sign side) {
        std::vector<BoundaryFace> chosen;
        chosen.reserve(static_cast<std::size_t>(std::count(sides.begin(), sides.end(), side)));
        for (std::size_t i = 0; i < faces.size(); ++i)
            if (sides[i] == side)
                chosen.push_back({{}, faces[i]});
        in_parallel(chosen.size(), 1024,
                    [&](std::size_t i) { chosen[i].seen = seen_face(scene.mesh(), chosen[i].owner, eye); });
        return chosen;
    };
    return {with_side(Sign::negative), with_side(Sign::positive)};
}

ExitsAndEntries surface_triangles(const Scene& scene, const glm::dvec4& eye)
{
    std::vector<BoundaryFace> triangles(scene.cell_count());
    in_parallel(triangles.size(), 1024, [&](std::size_t i) {
        const CellFace triangle{static_cast<CellId>(i), 0};
        triangles[i] = {seen_face(scene.mesh(), triangle, eye), triangle};
    });
    std::erase_if(triangles, [](const BoundaryFace& t) { return t.seen.turn == Sign::zero; });
    return {triangles, triangles};
}

// The faces that a chart may show, ascending, and their boxes.
struct ChartFaces {
    std::vector<std::uint32_t> faces;
    std::vector<Box> boxes;
};

ChartFaces faces_in_chart(const std::vector<BoundaryFace>& faces, const ProjectionCharts& charts, int chart)
{
    constexpr std::size_t block_size = 4096;
    std::vector<ChartFaces> blocks((faces.size() + block_size - 1) / block_size);
    in_parallel(blocks.size(), 1, [&](std::size_t block) {
        const std::size_t end = std::min((block + 1) * block_size, faces.size());
        for (std::size_t i = block * block_size; i < end; ++i)
            if (const auto box = charts.box(faces[i].seen.vertices(), chart)) {
                blocks[block].faces.push_back(static_cast<std::uint32_t>(i));
                blocks[block].boxes.push_back(*box);
            }
    });
    ChartFaces all;
    for (const ChartFaces& block : blocks) {
        all.faces.insert(all.faces.end(), block.faces.begin(), block.faces.end());
        all.boxes.insert(all.boxes.end(), block.boxes.begin(), block.boxes.end());
    }
    return all;
}

// Relations as numbers that ascend as they do, which sort faster.
std::uint64_t packed(CellId front, CellId back)
{
    return std::uint64_t{front} << 32 | back;
}
Relation unpacked(std::uint64_t relation)
{
    return {static_cast<CellId>(relation >> 32), static_cast<CellId>(relation)};
}

struct Found {
    std::vector<std::uint64_t> relations;
    std::vector<std::pair<CellId, CellId>> crossings;
    std::size_t candidates = 0;
};

class Search {
public:
    Search(const Scene& scene, const glm::dvec4& eye)
        : scene_(scene),
          eye_(eye),
          adjacency_(scene.is_surface() ? nullptr : &scene.adjacency()),
          faces_(scene.is_surface() ? surface_triangles(scene, eye) : boundary_of_solids(scene, eye))
    {
    }

    void run()
    {
        const ProjectionCharts charts(scene_.bounds(), eye_);
        for (int chart = 0; chart < charts.count(); ++chart) {
            const ChartFaces exits = faces_in_chart(faces_.exits, charts, chart);
            const ChartFaces entries = faces_in_chart(faces_.entries, charts, chart);
            if (exits.faces.empty() || entries.faces.empty())
                continue;
            const BoxHierarchy hierarchy(entries.boxes);
            in_parallel(exits.faces.size(), 64, [&](std::size_t i) {
                Found& found = found_.local();
                const BoundaryFace& f = faces_.exits[exits.faces[i]];
                // A face that is nearer than all of F is not covered by it.
                Box behind = exits.boxes[i];
                behind.max.z = std::numeric_limits<double>::infinity();
                hierarchy.search([&](const Box& box) { return box.meets(behind); },
                                 [&](std::uint32_t k) {
                                     test(f, faces_.entries[entries.faces[k]], found);
                                     return true;
                                 });
            });
        }
    }

    void collect(BoundaryRelations& result)
    {
        std::vector<std::uint64_t> relations;
        result.overlapping = scene_.overlapping_cells();
        result.candidates = 0;
        for (const Found& found : found_) {
            relations.insert(relations.end(), found.relations.begin(), found.relations.end());
            result.overlapping.insert(result.overlapping.end(), found.crossings.begin(), found.crossings.end());
            result.candidates += found.candidates;
        }
        // A pair is found once per chart and once for every two faces.
        oneapi::tbb::parallel_sort(relations);
        relations.erase(std::unique(relations.begin(), relations.end()), relations.end());
        std::vector<std::pair<CellId, CellId>>& overlapping = result.overlapping;
        std::sort(overlapping.begin(), overlapping.end());
        overlapping.erase(std::unique(overlapping.begin(), overlapping.end()), overlapping.end());
        if (!overlapping.empty())
            std::erase_if(relations, [&](std::uint64_t packed) {
                const Relation relation = unpacked(packed);
                const std::pair<CellId, CellId> pair = std::minmax(relation.front, relation.back);
                return std::binary_search(overlapping.begin(), overlapping.end(), pair);
            });
        result.relations.resize(relations.size());
        in_parallel(relations.size(), 4096, [&](std::size_t i) { result.relations[i] = unpacked(relations[i]); });
    }

private:
    void test(const BoundaryFace& f, const BoundaryFace& g, Found& found) const
    {
        const CellId front = f.owner.cell, back = g.owner.cell;
        if (front == back || (adjacency_ != nullptr && adjacency_->joins(front, back)))
            return;
        if (surely_not_nearer(f.seen, g.seen))
            return;
        ++found.candidates;
        const Overlap overlap = face_overlap(f.seen, g.seen, eye_);
        if (overlap == Overlap::crossing)
            found.crossings.push_back(std::minmax(front, back));
        else if (overlap == Overlap::nearer || (overlap == Overlap::coincident && adjacency_ != nullptr))
            found.relations.push_back(packed(front, back));
    }

    const Scene& scene_;
    glm::dvec4 eye_;
    const Adjacency* adjacency_; // none in a surface scene, whose triangles' common edges say nothing of their order
    ExitsAndEntries faces_;
    oneapi::tbb::enumerable_thread_specific<Found> found_;
};

} // namespace

void boundary_relations(const Scene& scene, const glm::dvec4& eye, BoundaryRelations& result)
{
    Search search(scene, eye);
    search.run();
    search.collect(result);
}

} // namespace visorder::detail
