#pragma once

#include "geometry/exact_predicates.h"

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>

namespace visorder::detail {

/// How a face F lies to a face G along the rays from the eye that meet both.
enum class Overlap {
    disjoint,   ///< no such rays, or none but grazing ones: the projections share no area
    nearer,     ///< F is nearer on all common rays but where the two touch
    coincident, ///< F and G lie in one plane
    farther,    ///< F is farther on all common rays but where the two touch
    crossing    ///< F is nearer on some and farther on others
};

/// A planar convex face as one eye sees it, made once for many overlap tests: its vertices without repetitions.
struct SeenFace {
    std::array<glm::dvec3, 4> points; ///< the first three span the plane, unless `turn` is zero
    int count = 0;
    Sign turn = Sign::zero; ///< positive where the eye sees the vertices counterclockwise; zero: edge-on, or no area

    std::span<const glm::dvec3> vertices() const { return {points.data(), static_cast<std::size_t>(count)}; }
};

/// `face` has up to four vertices in order around the face, which may repeat.
SeenFace seen_face(std::span<const glm::dvec3> face, const glm::dvec4& eye);

/// How F lies to G, decided exactly. The eye is homogeneous: the projection is along a direction (w = 0) or onto the
/// sphere of directions around a position, so faces may lie anywhere around it. A face that is edge-on has no projected
/// area and overlaps nothing.
Overlap face_overlap(const SeenFace& f, const SeenFace& g, const glm::dvec4& eye);

/// The same of two faces whose projections are known to share an area.
Overlap depth_overlap(const SeenFace& f, const SeenFace& g, const glm::dvec4& eye);

/// A quick test that is sometimes enough: whether G lies in front of F's plane, or F behind G's, for sure. Then F is
/// nearer than G nowhere, and the two neither cross nor coincide.
bool surely_not_nearer(const SeenFace& f, const SeenFace& g);

/// The same for one pair.
Overlap face_overlap(std::span<const glm::dvec3> f, std::span<const glm::dvec3> g, const glm::dvec4& eye);

/// A point of G, rounded, on a ray that meets the interiors of both faces, which overlap: the mean of the corners of
/// the shadow that F casts on G, as far as the shadow lies within G.
glm::dvec3 common_point(const SeenFace& f, const SeenFace& g, const glm::dvec4& eye);

} // namespace visorder::detail
