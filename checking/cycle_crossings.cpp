#include "checking/cycle_crossings.h"

#include "checking/convex_body.h"
#include "checking/image_boxes.h"
#include "geometry/box_hierarchy.h"

#include <algorithm>
#include <limits>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace visorder::detail {

namespace {

// A cell that some known relation joins with a set, or with its set, and whether it is behind that or in front.
struct Neighbour {
    CellId cell;
    bool behind;

    friend bool operator==(const Neighbour&, const Neighbour&) = default;
    friend bool operator<(const Neighbour& a, const Neighbour& b)
    {
        return std::pair(a.cell, a.behind) < std::pair(b.cell, b.behind);
    }
};

// Of each set, the cells in no set, and of all sets behind it, the cells: so that two sets meet once.
std::vector<std::vector<Neighbour>> neighbours_of_sets(const SetsAndNeighbours& known)
{
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
    std::vector<std::vector<Neighbour>> neighbours(known.sets.size());
    for (const Relation& relation : known.relations) {
        const std::uint32_t front = known.set_of[relation.front], back = known.set_of[relation.back];
        if (front != 0 && back != 0)
            joined.emplace_back(front - 1, back - 1);
        else if (front != 0)
            neighbours[front - 1].push_back({relation.back, true});
        else
            neighbours[back - 1].push_back({relation.front, false});
    }
    std::sort(joined.begin(), joined.end());
    joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
    for (const auto& [front, back] : joined)
        for (CellId cell : known.sets[back])
            neighbours[front].push_back({cell, true});
    for (std::vector<Neighbour>& of_set : neighbours) {
        std::sort(of_set.begin(), of_set.end());
        of_set.erase(std::unique(of_set.begin(), of_set.end()), of_set.end());
    }
    return neighbours;
}

} // namespace

std::vector<Relation> violations_across_sets(const Scene& scene, const glm::dvec4& eye, const SetsAndNeighbours& known,
                                             std::span<const std::uint32_t> positions)
{
    if (known.sets.empty())
        return {};
    const Mesh& mesh = scene.mesh();
    const glm::dvec4 from = eye.w < 0 ? -eye : eye;
    const std::vector<Box> boxes = image_boxes(scene, from);
    const auto violates = [&](CellId front, CellId back) {
        if (positions[front] > positions[back] ||
            std::binary_search(known.relations.begin(), known.relations.end(), Relation{front, back}) ||
            !can_occlude(mesh, front, from) || !can_occlude(mesh, back, from))
            return false;
        const ConvexBody f = body_of(mesh, front), b = body_of(mesh, back);
        return occludes(f, b, from) && !occludes(b, f, from);
    };
    oneapi::tbb::enumerable_thread_specific<std::vector<Relation>> parts;
    const std::vector<std::vector<Neighbour>> neighbours = neighbours_of_sets(known);
    for (std::size_t s = 0; s < known.sets.size(); ++s) {
        const std::vector<CellId>& set = known.sets[s];
        std::vector<Box> of_set;
        for (CellId cell : set) {
            of_set.push_back(boxes[cell]);
            // Distance says nothing here that the order does not.
            of_set.back().min.z = -std::numeric_limits<double>::infinity();
            of_set.back().max.z = std::numeric_limits<double>::infinity();
        }
        const BoxHierarchy hierarchy(of_set);
        oneapi::tbb::parallel_for(std::size_t{0}, neighbours[s].size(), [&](std::size_t i) {
            const Neighbour& neighbour = neighbours[s][i];
            std::vector<Relation>& found = parts.local();
            hierarchy.search([&](const Box& box) { return box.meets(boxes[neighbour.cell]); },
                             [&](std::uint32_t k) {
                                 Relation pair{set[k], neighbour.cell};
                                 if (!neighbour.behind)
                                     std::swap(pair.front, pair.back);
                                 if (violates(pair.front, pair.back))
                                     found.push_back(pair);
                                 return true;
                             });
        });
    }
    std::vector<Relation> all;
    for (const auto& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

} // namespace visorder::detail
