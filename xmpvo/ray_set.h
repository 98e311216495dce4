#pragma once

#include "geometry/exact_predicates.h"
#include "xmpvo/boundary_surface.h"

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

namespace visorder::detail {

/// A ray in unit coordinates; `direction` has length 1.
struct Ray {
    glm::dvec3 origin;
    glm::dvec3 direction;
};

/// The rays from an eye through points of a scene and beyond. They start at the eye or, where that is farther, just
/// outside of the scene: there single precision can still tell them apart.
class RaysFromEye {
public:
    /// `eye` as `unit_eye` has it.
    explicit RaysFromEye(const glm::dvec4& eye) : eye_(eye) {}

    /// None through the eye itself, nor along a direction that is lost in rounding.
    std::optional<Ray> through(const glm::dvec3& target) const;

private:
    glm::dvec4 eye_;
};

/// How many rays near to each other are shot together.
inline constexpr std::size_t most_rays = 4;

/// Takes up to `most_rays` points that rays are to be shot through; called by several threads at once.
using VisitTargets = std::function<void(std::span<const glm::dvec3> targets)>;

/// Visits the centre of every face that is not edge-on, and its corners, pulled in.
void visit_faces(const BoundarySurface& surface, std::span<const Sign> sides, const VisitTargets& visit);

/// How much there was to visit.
struct SilhouetteCounts {
    std::size_t edges = 0;     ///< between faces on different sides of which the eye lies
    std::size_t crossings = 0; ///< of two of them in projection
    std::size_t visited = 0;   ///< of these
};

/// Visits, at every crossing of two silhouette edges in projection, a point in each of the four sectors between them:
/// where one part of the boundary begins to cover another (Silva, Mitchell, Williams 1998, whose sweep stops at the
/// same crossings). Where there are more than four per boundary face, as among many cells that do not touch, an even
/// sample of about that many is visited, the same one each time: the rays would cost more than all pairs of faces.
/// Takes time by the number of crossings and of boxes around edges that meet. Rounded; a crossing at an edge's end may
/// be visited or not.
SilhouetteCounts visit_crossings(const BoundarySurface& surface, std::span<const Sign> sides, const glm::dvec4& eye,
                                 const VisitTargets& visit);

} // namespace visorder::detail
