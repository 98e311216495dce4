#include "bench/frames.h"

#include "scene/stopwatch.h"
#include "visorder/error.h"
#include "visorder/ray_caster.h"

namespace visorder::bench {

using namespace detail;

std::vector<MediumPoint> medium_of(const TransferFunction& function)
{
    std::vector<MediumPoint> medium;
    for (const OpticalPoint& p : function.points())
        medium.push_back({p.scalar, p.extinction, p.colour});
    return medium;
}

namespace {

TransferFunction function_for(const Scene& scene)
{
    if (scene.is_surface() && scene.mesh().scalars.empty())
        throw InputError("the surface has no scalars, and in one colour no order shows");
    return named_transfer_function("rainbow", scene, scene.diameter() / 40);
}

} // namespace

Frames::Frames(const Scene& scene, GlPlatform platform)
    : scene_(scene), context_(platform), function_(function_for(scene))
{
    const Context::Current current(context_);
    if (scene.is_surface()) {
        SurfaceOptions options;
        options.function = function_;
        surface_renderer_ = std::make_unique<SurfaceRenderer>(context_, scene, options);
    } else {
        renderer_ = std::make_unique<ProjectionRenderer>(context_, scene, function_);
    }
}

Image Frames::draw(const View& view, const Order& order)
{
    const Context::Current current(context_);
    return surface_renderer_ ? surface_renderer_->draw(view, order) : renderer_->draw(view, order);
}

std::vector<IntegratorResult> Frames::integrators(const View& view, const Order& order)
{
    if (surface_renderer_)
        return {};
    const std::vector<MediumPoint> medium = medium_of(function_);
    RayCastOptions options;
    options.silhouette_margin = 1;
    const RayCast truth = cast_rays(scene_, medium, view, options);
    const Image true_image = image_of(truth);
    const Context::Current current(context_);
    std::vector<IntegratorResult> results;
    for (const Integrator integrator : visorder::integrators()) {
        RenderOptions render;
        render.integrator = integrator;
        ProjectionRenderer renderer(context_, scene_, function_, render);
        renderer.draw(view, order); // makes tables and programs
        Stopwatch watch;
        const Image image = renderer.draw(view, order);
        const double seconds = watch.lap();
        results.push_back({name(integrator), image_errors(image, true_image, truth.near_silhouette), seconds});
    }
    return results;
}

} // namespace visorder::bench
