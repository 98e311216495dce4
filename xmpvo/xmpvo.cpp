#include "xmpvo/xmpvo.h"

#include "visorder/error.h"
#include "visorder/sorter_options.h"

#include <algorithm>
#include <array>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_sort.h>

namespace visorder::detail {

namespace {

// Hits so near to each other that single precision may have them in the wrong order.
constexpr float no_distance = 0x1p-18f;

// What one thread's rays found.
struct Found {
    std::array<std::vector<RayHit>, most_rays> hits;
    FacePairs pairs;
    std::size_t ray_count = 0;
    std::size_t hit_count = 0;
};

} // namespace

Xmpvo::Xmpvo(const Scene& scene, XmpvoRays rays)
    : scene_(scene),
      rays_(rays),
      surface_(scene.is_surface()
                   ? throw InputError("xmpvo orders solid cells; the triangles of a surface have no exits")
                   : boundary_surface(scene)),
      embree_(surface_)
{
}

Guarantee Xmpvo::guarantee() const
{
    return scene_.traits().convex ? Guarantee::exact : Guarantee::approximate;
}

// Fills pairs_ with those of exit and entry faces that follow each other along a ray.
void Xmpvo::shoot(const glm::dvec4& eye)
{
    pairs_.clear();
    ray_count_ = hit_count_ = 0;
    silhouette_ = {};
    if (eye == glm::dvec4(0)) // no doubles hold it in unit coordinates, so none of its rays either
        return;
    const RaysFromEye rays(eye);
    oneapi::tbb::enumerable_thread_specific<Found> found_by_threads;
    const auto shoot_through = [&](std::span<const glm::dvec3> targets) {
        std::array<Ray, most_rays> shot;
        std::size_t count = 0;
        for (const glm::dvec3& target : targets)
            if (const auto ray = rays.through(target))
                shot[count++] = *ray;
        Found& found = found_by_threads.local();
        embree_.shoot(std::span(shot).first(count), found.hits);
        found.ray_count += count;
        for (std::size_t i = 0; i < count; ++i) {
            found.hit_count += found.hits[i].size();
            found.pairs.add(found.hits[i], sides_, no_distance);
        }
    };
    visit_faces(surface_, sides_, shoot_through);
    silhouette_ =
        rays_ == XmpvoRays::crossings ? visit_crossings(surface_, sides_, eye, shoot_through) : SilhouetteCounts{};

    for (const Found& found : found_by_threads) {
        pairs_.insert(pairs_.end(), found.pairs.pairs().begin(), found.pairs.pairs().end());
        ray_count_ += found.ray_count;
        hit_count_ += found.hit_count;
    }
    oneapi::tbb::parallel_sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

void Xmpvo::sort(const View& view, Order& order)
{
    validate(view);
    signs_.evaluate(scene_, view.eye);
    face_sides(scene_, signs_, sides_);
    shoot(unit_eye(scene_.face_planes().frame, view.eye));
    confirm_pairs(scene_, view.eye, pairs_, relations_);
    topological_sort_.run(scene_, signs_, relations_, order);
}

std::size_t Xmpvo::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return surface_.bytes() + embree_.bytes() + signs_.bytes() + size_of(sides_) + size_of(pairs_) +
           size_of(relations_) + topological_sort_.bytes();
}

std::vector<Statistic> Xmpvo::statistics() const
{
    return {{"silhouette edges", static_cast<double>(silhouette_.edges)},
            {"crossings", static_cast<double>(silhouette_.visited), static_cast<double>(silhouette_.crossings)},
            {"rays", static_cast<double>(ray_count_)},
            {"hits", static_cast<double>(hit_count_)},
            {"pairs of faces", static_cast<double>(pairs_.size())},
            {"relations", static_cast<double>(relations_.size())}};
}

} // namespace visorder::detail
