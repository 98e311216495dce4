#pragma once

#include "visorder/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>

namespace visorder::scenes {

/// How many along each axis.
using LatticeSize = std::array<std::size_t, 3>;

/// A size with about `count` in all, about in these proportions, none below `least`.
LatticeSize lattice_size(std::size_t count, const glm::dvec3& proportions, const LatticeSize& least);

/// Appends the hexahedra between the points of a lattice, in VTK's vertex order where the three axes are right-handed.
/// The lattice's points are the mesh's last: of these, point (i, j, k) is number i + points[0] * (j + points[1] * k).
/// With `closed`, the last points along the second axis meet the first again.
void add_hexahedra(Mesh& mesh, const LatticeSize& points, bool closed);

/// The same, but only the hexahedra for which `keep` is true of their lowest corner (i, j, k).
void add_hexahedra(Mesh& mesh, const LatticeSize& points, bool closed,
                   const std::function<bool(const LatticeSize& corner)>& keep);

/// The smallest count for which `size_of(count)`, which grows, is at least `size`; at most `size`.
template <class SizeOf>
std::size_t count_for(std::size_t size, SizeOf&& size_of)
{
    std::size_t low = 0;
    std::size_t high = size;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (size_of(static_cast<double>(middle)) < static_cast<double>(size))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

} // namespace visorder::scenes
