#include "mpvo/mpvo.h"

#include "visorder/error.h"

namespace visorder::detail {

namespace {

constexpr std::span<const Relation> no_boundary_relations;

} // namespace

Mpvo::Mpvo(const Scene& scene) : scene_(scene)
{
    if (scene.is_surface())
        throw InputError("mpvo orders solid cells; the triangles of a surface share no faces");
    scene.face_planes();
}

Guarantee Mpvo::guarantee() const
{
    return scene_.traits().convex ? Guarantee::exact : Guarantee::approximate;
}

void Mpvo::sort(const View& view, Order& order)
{
    validate(view);
    signs_.evaluate(scene_, view.eye);
    topological_sort_.run(scene_, signs_, no_boundary_relations, order);
}

} // namespace visorder::detail
