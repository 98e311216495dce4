#pragma once

#include "visorder/relation.h"
#include "visorder/scene.h"

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// Strongly connected sets of cells under the relations that are known, and the known relations that enter or leave
/// them. Inner numbering.
struct SetsAndNeighbours {
    std::vector<std::vector<CellId>> sets; ///< more than one cell each
    std::vector<std::uint32_t> set_of;     ///< of every cell: 1 + index into sets, or 0
    std::vector<Relation> relations;       ///< between different sets, or a set and a cell in none; ascending
};

/// The pairs that a wrong order can hide behind a cycle: `front` occludes `back`, no relation of the two is known, and
/// `front` stands before `back` in the order. Ascending.
///
/// Along a ray, every cell has a known relation with the next. An order that satisfies all of these but those within
/// sets can be wrong about two cells of the ray all the same. Of the nearest such two, every cell between them is in a
/// set with one of them, or it would stand between them in the order as well. So a known relation leads from the set of
/// the one to the set of the other. All pairs of two sets joined in this way are tried, or of a set and a cell, that
/// the order has the wrong way round and whose boxes meet in the image; each is confirmed by `occludes` in both
/// directions, which knows nothing of the relations.
std::vector<Relation> violations_across_sets(const Scene& scene, const glm::dvec4& eye, const SetsAndNeighbours& known,
                                             std::span<const std::uint32_t> positions);

} // namespace visorder::detail
