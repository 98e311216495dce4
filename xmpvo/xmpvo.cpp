#include "xmpvo/xmpvo.h"

#include "scene/error.h"
#include "scene/face_overlap.h"

#include <algorithm>
#include <array>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

namespace visorder {

namespace {

// Hits so near to each other that single precision may have them in the wrong order.
constexpr float no_distance = 0x1p-18f;
constexpr std::size_t remembered = 1 << 15; // pairs

// What one thread's rays found.
struct Found {
    std::array<std::vector<RayHit>, most_rays> hits;
    std::vector<std::uint32_t> left;  // exit faces where a ray left last, at one distance
    std::vector<std::uint32_t> exits; // faces that it meets next, at one distance
    std::vector<std::uint32_t> entries;
    std::vector<std::uint64_t> pairs;
    // Most rays find what their neighbours did.
    std::vector<std::uint64_t> latest = std::vector<std::uint64_t>(remembered, ~std::uint64_t{0});
    std::size_t ray_count = 0;
    std::size_t hit_count = 0;

    void propose(const std::vector<std::uint32_t>& fronts)
    {
        for (std::uint32_t exit : fronts)
            for (std::uint32_t entry : entries) {
                const std::uint64_t pair = std::uint64_t{exit} << 32 | entry;
                std::uint64_t& last = latest[(exit * 0x9e3779b1u ^ entry * 0x85ebca6bu) >> 17];
                if (last != pair)
                    pairs.push_back(last = pair);
            }
    }

    // Each exit of the ray is paired with the next entry.
    void pair_hits(std::span<const RayHit> hits_of_ray, std::span<const Sign> sides)
    {
        left.clear();
        for (std::size_t i = 0; i < hits_of_ray.size();) {
            exits.clear();
            entries.clear();
            do {
                const std::uint32_t face = hits_of_ray[i].face;
                if (sides[face] == Sign::negative)
                    exits.push_back(face);
                else if (sides[face] == Sign::positive)
                    entries.push_back(face);
                ++i;
            } while (i < hits_of_ray.size() && hits_of_ray[i].distance <= hits_of_ray[i - 1].distance + no_distance);
            propose(left);
            propose(exits);
            if (!exits.empty() || !entries.empty())
                std::swap(left, exits);
        }
    }
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
            found.pair_hits(found.hits[i], sides_);
        }
    };
    visit_faces(surface_, sides_, shoot_through);
    silhouette_ = rays_ == XmpvoRays::crossings ? visit_crossings(surface_, sides_, eye, shoot_through) : Silhouette{};

    pairs_.clear();
    ray_count_ = hit_count_ = 0;
    for (const Found& found : found_by_threads) {
        pairs_.insert(pairs_.end(), found.pairs.begin(), found.pairs.end());
        ray_count_ += found.ray_count;
        hit_count_ += found.hit_count;
    }
    oneapi::tbb::parallel_sort(pairs_);
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

// Makes relations_ of those pairs that are such from `eye`.
void Xmpvo::confirm(const glm::dvec4& eye)
{
    const std::vector<CellFace>& faces = scene_.boundary().faces;
    const Adjacency& adjacency = scene_.adjacency();
    oneapi::tbb::enumerable_thread_specific<std::vector<Relation>> confirmed_by_threads;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pairs_.size(), 256), [&](const auto& range) {
        std::vector<Relation>& confirmed = confirmed_by_threads.local();
        SeenFace exit;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const auto exit_face = static_cast<std::uint32_t>(pairs_[i] >> 32);
            const CellFace& front = faces[exit_face];
            const CellFace& back = faces[static_cast<std::uint32_t>(pairs_[i])];
            if (i == range.begin() || exit_face != pairs_[i - 1] >> 32)
                exit = seen_face(scene_.mesh(), front, eye);
            if (front.cell == back.cell || adjacency.joins(front.cell, back.cell))
                continue;
            const Overlap overlap = face_overlap(exit, seen_face(scene_.mesh(), back, eye), eye);
            if (overlap == Overlap::nearer || overlap == Overlap::coincident)
                confirmed.push_back({front.cell, back.cell});
        }
    });
    relations_.clear();
    for (const std::vector<Relation>& confirmed : confirmed_by_threads)
        relations_.insert(relations_.end(), confirmed.begin(), confirmed.end());
    std::sort(relations_.begin(), relations_.end());
    relations_.erase(std::unique(relations_.begin(), relations_.end()), relations_.end());
}

void Xmpvo::sort(const View& view, Order& order)
{
    validate(view);
    signs_.evaluate(scene_, view.eye);
    const std::vector<CellFace>& faces = scene_.boundary().faces;
    sides_.resize(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const CellFace& face = faces[i];
        sides_[i] = (signs_.entry(face.cell) >> face.face & 1u) != 0  ? Sign::positive
                    : (signs_.exit(face.cell) >> face.face & 1u) != 0 ? Sign::negative
                                                                      : Sign::zero;
    }
    shoot(unit_eye(scene_.face_planes(), view.eye));
    confirm(view.eye);
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
            {"crossings", static_cast<double>(silhouette_.crossings)},
            {"rays", static_cast<double>(ray_count_)},
            {"hits", static_cast<double>(hit_count_)},
            {"pairs of faces", static_cast<double>(pairs_.size())},
            {"relations", static_cast<double>(relations_.size())}};
}

std::unique_ptr<Sorter> make_xmpvo(const Scene& scene, const SorterOptions& options)
{
    return std::make_unique<Xmpvo>(scene, options.xmpvo_rays);
}

} // namespace visorder
