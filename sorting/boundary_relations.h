#pragma once

#include "scene/boundary.h"
#include "visorder/relation.h"
#include "visorder/scene.h"

#include <cstddef>
#include <glm/vec4.hpp>
#include <utility>
#include <vector>

namespace visorder::detail {

/// What the boundary faces of a scene say about its order from one eye; cells in the inner numbering.
struct BoundaryRelations {
    /// Ascending, each pair once: from the owner of an exit face F to the owner of an entry face G that F covers in
    /// part, nearer or coincident. Without the pairs of cells that share an interior face, whose relation that face
    /// carries, and without the `overlapping` ones.
    std::vector<Relation> relations;
    /// Pairs (a, b), a < b, ascending, of which no order exists: the scene's cells that overlap in space, and the
    /// triangles of a surface that cross as seen from the eye.
    std::vector<std::pair<CellId, CellId>> overlapping;
    std::size_t candidates = 0; ///< pairs of faces put to the exact test
};

/// Finds all boundary relations of a scene from an eye, exactly; reuses the memory of `result`. In a surface scene
/// every triangle that is not edge-on is both an exit and an entry face, and two in one plane have no relation.
///
/// The idea: every pair of an exit and an entry face is tested whose boxes overlap in a chart of the projection, one
/// plane along a direction and the six sides of a cube around a position. Boxes are rounded outward; what they let
/// through, `face_overlap` decides. The result does not depend on the number of threads.
void boundary_relations(const Scene& scene, const glm::dvec4& eye, BoundaryRelations& result);

} // namespace visorder::detail
