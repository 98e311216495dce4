#include "xmpvo/xmpvo_exact.h"

#include "scene/adjacency.h"
#include "scene/overlap_planes.h"
#include "sorting/tentative_relations.h"

namespace visorder::detail {

XmpvoExact::XmpvoExact(const Scene& scene) : scene_(scene)
{
    if (scene.is_surface())
        return;
    scene.face_planes();
    scene.relation_faces();
    scene.overlap_planes();
}

void XmpvoExact::sort(const View& view, Order& order)
{
    validate(view);
    boundary_relations(scene_, view.eye, boundary_);
    if (scene_.is_surface()) {
        topological_sort_.run(scene_, boundary_.relations, order);
        return;
    }
    signs_.evaluate(scene_, view.eye);
    tentative_relations(scene_, view.eye, tentative_);
    topological_sort_.run(scene_, signs_, boundary_.relations, tentative_, order);
}

std::size_t XmpvoExact::bytes() const
{
    return signs_.bytes() + topological_sort_.bytes() + boundary_.relations.capacity() * sizeof(Relation) +
           boundary_.overlapping.capacity() * sizeof(boundary_.overlapping[0]) +
           tentative_.capacity() * sizeof(Relation);
}

std::vector<Statistic> XmpvoExact::statistics() const
{
    return {{"candidate pairs", static_cast<double>(boundary_.candidates)},
            {"relations", static_cast<double>(boundary_.relations.size())}};
}

} // namespace visorder::detail
