#include "depth/power.h"

#include "depth/sortable_key.h"
#include "scene/circumspheres.h"

#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

Power::Power(const Scene& scene) : scene_(scene)
{
    scene.circumspheres();
}

void Power::sort(const View& view, Order& order)
{
    validate(view);
    const Circumspheres& spheres = scene_.circumspheres();
    keys_.resize(scene_.cell_count());
    resize_on_large_pages(order.back_to_front, scene_.cell_count());
    order.layer_begin.clear();
    order.cycles.clear();
    // |w| times the power, less the square of the eye's distance from the origin, which all cells have in common: what
    // is left has no terms that cancel. For a direction, w = 0, it is the limit of distant eyes.
    const double sign = view.eye.w < 0 ? -1 : 1;
    const double weight = sign * view.eye.w;
    const glm::dvec3 twice_eye = 2 * sign * (glm::dvec3(view.eye) - view.eye.w * spheres.origin);
    oneapi::tbb::parallel_for(
        oneapi::tbb::blocked_range<CellId>(0, scene_.cell_count(), 16384), [&](const auto& range) {
            for (CellId cell = range.begin(); cell < range.end(); ++cell)
                keys_[cell] =
                    descending_key(weight * spheres.constant[cell] - glm::dot(spheres.centre[cell], twice_eye));
        });
    radix_sort_.sort(keys_, scene_.caller_cells(), order.back_to_front);
}

} // namespace visorder::detail
