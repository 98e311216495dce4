#include "bench/constant_medium.h"

#include "bench/frames.h"
#include "visorder/ray_caster.h"

#include <algorithm>
#include <cmath>

namespace visorder::bench {

using namespace scenes;

namespace {

std::vector<glm::dvec4> truth(const Scene& scene, const View& view, const glm::dvec2& moved)
{
    View seen = view;
    // Pixels' centres go by `moved` if the image goes the other way.
    glm::dmat4 shift(1);
    shift[3] = glm::dvec4(-2.0 * moved / glm::dvec2(view.size), 0.0, 1.0);
    seen.world_to_clip = shift * view.world_to_clip;
    return cast_rays(scene, medium_of(constant_medium(scene)), seen).pixels;
}

} // namespace

TransferFunction constant_medium(const Scene& scene)
{
    return TransferFunction({{0, extinction_of(0.3, scene.diameter() / 10), glm::dvec3(0.5)}});
}

TransmittanceErrors transmittance_errors(const Scene& scene, const View& view, const Image& drawn, double tolerance)
{
    TransmittanceErrors errors;
    const std::vector<glm::dvec4> wanted = truth(scene, view, {0, 0});
    std::vector<double> off(wanted.size());
    std::vector<std::size_t> doubtful;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        off[i] = std::abs(static_cast<double>(drawn.pixels[i].w) - wanted[i].w);
        if (!(off[i] <= tolerance))
            doubtful.push_back(i);
    }
    if (!doubtful.empty()) {
        constexpr double nudge = 1e-9;
        for (const glm::dvec2 to : {glm::dvec2(nudge, 0.7 * nudge), glm::dvec2(-0.7 * nudge, nudge),
                                    glm::dvec2(-nudge, -0.7 * nudge), glm::dvec2(0.7 * nudge, -nudge)}) {
            const std::vector<glm::dvec4> beside = truth(scene, view, to);
            for (const std::size_t i : doubtful)
                off[i] = std::min(off[i], std::abs(static_cast<double>(drawn.pixels[i].w) - beside[i].w));
        }
    }
    errors.pixels = off.size();
    for (std::size_t i = 0; i < off.size(); ++i) {
        errors.beyond += off[i] <= tolerance ? 0 : 1;
        if (off[i] > errors.largest || std::isnan(off[i])) {
            errors.largest = off[i];
            errors.largest_at = {static_cast<int>(i) % view.size.x, static_cast<int>(i) / view.size.x};
        }
    }
    return errors;
}

std::vector<NamedView> twenty_views(const Scene& scene, glm::ivec2 size)
{
    std::vector<NamedView> views = hard_views(scene, size);
    const double radius = scene.diameter() / 2;
    glm::dvec3 eye(0);
    for (const PointId p : scene.mesh().cell(scene.cell_count() / 3))
        eye += 0.25 * scene.mesh().points[p];
    views.push_back(
        {"inside, at 120 degrees", look_at(eye, eye + glm::dvec3(0.3, 0.2, 1) * radius, radius, 120, size)});
    constexpr std::size_t wanted = 20;
    const int more = static_cast<int>(wanted - std::min(wanted, views.size()));
    for (NamedView& view : random_views(scene, more, 5, size))
        views.push_back(std::move(view));
    return views;
}

} // namespace visorder::bench
