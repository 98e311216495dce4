#include "sorting/face_pairs.h"

#include "geometry/face_overlap.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_planes.h"
#include "scene/seen_face.h"
#include "visorder/scene.h"

#include <algorithm>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace visorder::detail {

void FacePairs::propose(const std::vector<std::uint32_t>& fronts)
{
    for (std::uint32_t exit : fronts)
        for (std::uint32_t entry : entries_) {
            const std::uint64_t pair = std::uint64_t{exit} << 32 | entry;
            std::uint64_t& last = latest_[(exit * 0x9e3779b1u ^ entry * 0x85ebca6bu) >> (32 - remembered)];
            if (last != pair)
                pairs_.push_back(last = pair);
        }
}

void FacePairs::add(std::span<const RayHit> hits_of_ray, std::span<const Sign> sides, float together)
{
    left_.clear();
    for (std::size_t i = 0; i < hits_of_ray.size();) {
        exits_.clear();
        entries_.clear();
        do {
            const std::uint32_t face = hits_of_ray[i].face;
            if (sides[face] == Sign::negative)
                exits_.push_back(face);
            else if (sides[face] == Sign::positive)
                entries_.push_back(face);
            ++i;
        } while (i < hits_of_ray.size() && hits_of_ray[i].distance <= hits_of_ray[i - 1].distance + together);
        propose(left_);
        propose(exits_);
        if (!exits_.empty() || !entries_.empty())
            std::swap(left_, exits_);
    }
}

void face_sides(const Scene& scene, const FaceSigns& signs, std::vector<Sign>& sides)
{
    const std::vector<CellFace>& faces = scene.boundary().faces;
    sides.resize(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const CellFace& face = faces[i];
        sides[i] = (signs.entry(face.cell) >> face.face & 1u) != 0  ? Sign::positive
                   : (signs.exit(face.cell) >> face.face & 1u) != 0 ? Sign::negative
                                                                    : Sign::zero;
    }
}

void confirm_pairs(const Scene& scene, const glm::dvec4& eye, std::span<const std::uint64_t> pairs,
                   std::vector<Relation>& relations)
{
    const std::vector<CellFace>& faces = scene.boundary().faces;
    const Adjacency& adjacency = scene.adjacency();
    oneapi::tbb::enumerable_thread_specific<std::vector<Relation>> confirmed_by_threads;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pairs.size(), 256), [&](const auto& range) {
        std::vector<Relation>& confirmed = confirmed_by_threads.local();
        SeenFace exit;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const auto exit_face = static_cast<std::uint32_t>(pairs[i] >> 32);
            const CellFace& front = faces[exit_face];
            const CellFace& back = faces[static_cast<std::uint32_t>(pairs[i])];
            if (i == range.begin() || exit_face != pairs[i - 1] >> 32)
                exit = seen_face(scene.mesh(), front, eye);
            if (front.cell == back.cell || adjacency.joins(front.cell, back.cell))
                continue;
            const Overlap overlap = face_overlap(exit, seen_face(scene.mesh(), back, eye), eye);
            if (overlap == Overlap::nearer || overlap == Overlap::coincident)
                confirmed.push_back({front.cell, back.cell});
        }
    });
    relations.clear();
    for (const std::vector<Relation>& confirmed : confirmed_by_threads)
        relations.insert(relations.end(), confirmed.begin(), confirmed.end());
    std::sort(relations.begin(), relations.end());
    relations.erase(std::unique(relations.begin(), relations.end()), relations.end());
}

} // namespace visorder::detail
