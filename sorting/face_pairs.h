#pragma once

#include "geometry/exact_predicates.h"
#include "scene/face_planes.h"
#include "visorder/relation.h"
#include "visorder/scene.h"

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

class FaceSigns;

/// A boundary face that a ray from the eye meets.
struct RayHit {
    float distance; ///< grows along the ray
    std::uint32_t face;
};

/// Pairs of boundary faces that follow each other along rays: where a ray leaves the mesh, and where it comes back.
/// They propose relations, of which `confirm_pairs` keeps those that are such; an inexact ray does no harm. One object
/// a thread.
class FacePairs {
public:
    /// Pairs each exit face of a ray with the entry faces that follow next. Hits that are no farther apart than
    /// `together` may be in the wrong order: they are taken in each. `sides` are those of all faces (`face_sides`).
    void add(std::span<const RayHit> hits_of_ray, std::span<const Sign> sides, float together);

    /// Exit face << 32 | entry face, some more than once.
    const std::vector<std::uint64_t>& pairs() const { return pairs_; }

private:
    void propose(const std::vector<std::uint32_t>& fronts);

    static constexpr int remembered = 15; // as a power of two

    std::vector<std::uint32_t> left_;  // exit faces where the ray left last, at one distance
    std::vector<std::uint32_t> exits_; // faces that it meets next, at one distance
    std::vector<std::uint32_t> entries_;
    std::vector<std::uint64_t> pairs_;
    // Most rays find what their neighbours did.
    std::vector<std::uint64_t> latest_ = std::vector<std::uint64_t>(std::size_t{1} << remembered, ~std::uint64_t{0});
};

/// Of each boundary face: `negative` for an exit face, `positive` for an entry face, `zero` where it is edge-on.
void face_sides(const Scene& scene, const FaceSigns& signs, std::vector<Sign>& sides);

/// The relations among pairs of boundary faces, exit << 32 | entry, ascending and each once: decided exactly.
/// Ascending, each once, without pairs of cells that share an interior face.
void confirm_pairs(const Scene& scene, const glm::dvec4& eye, std::span<const std::uint64_t> pairs,
                   std::vector<Relation>& relations);

} // namespace visorder::detail
