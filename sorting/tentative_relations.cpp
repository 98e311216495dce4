#include "sorting/tentative_relations.h"

#include "geometry/exact_predicates.h"
#include "scene/overlap_planes.h"
#include "visorder/scene.h"

namespace visorder::detail {

void tentative_relations(const Scene& scene, const glm::dvec4& eye, std::vector<Relation>& relations)
{
    relations.clear();
    if (scene.overlapping_cells().empty())
        return;
    const auto& points = scene.mesh().points;
    for (const OverlapPlane& pair : scene.overlap_planes()) {
        const auto& [a, b, c] = pair.plane;
        const Sign side = side_of_plane(points[a], points[b], points[c], eye);
        if (side == Sign::positive)
            relations.push_back({pair.near, pair.far});
        else if (side == Sign::negative)
            relations.push_back({pair.far, pair.near});
    }
}

} // namespace visorder::detail
