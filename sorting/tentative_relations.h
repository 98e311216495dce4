#pragma once

#include "visorder/relation.h"
#include "visorder/scene.h"

#include <glm/vec4.hpp>
#include <vector>

namespace visorder::detail {

/// Relations between cells that overlap in space, the best-founded first, as the planes that nearly separate them have
/// them (see OverlapPlane): no order of such a pair exists, but one is nearer to the truth than the other. A sorter
/// gives them up where they contradict relations, or each other. Reuses the memory of `relations`.
void tentative_relations(const Scene& scene, const glm::dvec4& eye, std::vector<Relation>& relations);

} // namespace visorder::detail
