#include "bench/frames.h"

#include "checking/ray_caster.h"
#include "scene/error.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

namespace visorder {

namespace {

TransferFunction medium_of(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    if (!scene.is_tetrahedral())
        throw InputError("frames are drawn of tetrahedra alone");
    if (mesh.scalars.empty())
        throw InputError("frames need scalars");
    const auto [lowest, highest] = std::minmax_element(mesh.scalars.begin(), mesh.scalars.end());
    const double diameter = glm::length(scene.bounds().max - scene.bounds().min);
    return named_transfer_function("rainbow", *lowest, *highest, diameter > 0 ? diameter / 40 : 1);
}

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

Frames::Frames(const Scene& scene, GlPlatform platform) : scene_(scene), context_(platform), medium_(medium_of(scene))
{
    const Context::Current current(context_);
    renderer_ = std::make_unique<ProjectionRenderer>(context_, scene, medium_);
}

Image Frames::draw(const View& view, const Order& order)
{
    const Context::Current current(context_);
    return renderer_->draw(view, order);
}

std::vector<IntegratorResult> Frames::integrators(const View& view, const Order& order)
{
    std::vector<MediumPoint> medium;
    for (const OpticalPoint& p : medium_.points())
        medium.push_back({p.scalar, p.extinction, p.colour});
    RayCastOptions options;
    options.silhouette_margin = 1;
    const RayCast truth = cast_rays(scene_, medium, view, options);
    const Image true_image = image_of(truth);
    const Context::Current current(context_);
    std::vector<IntegratorResult> results;
    for (const Integrator integrator : visorder::integrators()) {
        RenderOptions render;
        render.integrator = integrator;
        ProjectionRenderer renderer(context_, scene_, medium_, render);
        renderer.draw(view, order); // makes tables and programs
        const double begin = now();
        const Image image = renderer.draw(view, order);
        const double seconds = now() - begin;
        results.push_back({name(integrator), image_errors(image, true_image, truth.near_silhouette), seconds});
    }
    return results;
}

} // namespace visorder
