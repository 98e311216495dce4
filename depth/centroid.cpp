#include "depth/centroid.h"

#include "depth/sortable_key.h"
#include "parallel/large_array.h"

#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

Centroid::Centroid(const Scene& scene) : scene_(scene)
{
    scene.centroids();
}

void Centroid::sort(const View& view, Order& order)
{
    validate(view);
    const LargeArray<glm::vec3>& centroids = scene_.centroids();
    keys_.resize(scene_.cell_count());
    resize_on_large_pages(order.back_to_front, scene_.cell_count());
    order.layer_begin.clear();
    order.cycles.clear();
    const auto fill_keys = [&](auto&& distance) {
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, scene_.cell_count(), 16384),
                                  [&](const auto& range) {
                                      for (CellId cell = range.begin(); cell < range.end(); ++cell)
                                          keys_[cell] = descending_key(distance(centroids[cell]));
                                  });
    };
    if (view.eye.w == 0) {
        const glm::vec3 towards(glm::normalize(glm::dvec3(view.eye)));
        fill_keys([&](const glm::vec3& c) { return -glm::dot(c, towards); });
    } else {
        const glm::vec3 eye(glm::dvec3(view.eye) / view.eye.w - scene_.bounds().middle());
        fill_keys([&](const glm::vec3& c) { return glm::dot(c - eye, c - eye); });
    }
    radix_sort_.sort(keys_, scene_.caller_cells(), order.back_to_front);
}

} // namespace visorder::detail
