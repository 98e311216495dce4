#pragma once

#include "projection/visible_cells.h"

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <span>

namespace visorder::detail {

/// Triangles with their corners on the rasteriser's lattice, in lattice steps, that cover each pixel once.
class Outline {
public:
    using Triangle = std::array<glm::ivec2, 3>;

    void add(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) { triangles_[count_++] = {a, b, c}; }
    std::span<const Triangle> triangles() const { return {triangles_.data(), count_}; }

private:
    std::array<Triangle, 4> triangles_; // the first `count_` of them
    std::size_t count_ = 0;
};

/// One triangle or two around a cell's silhouette, so much larger that they hold all of it, wherever rounding to the
/// lattice takes their corners.
Outline outline_of(const VisibleCell& cell, const RasterLattice& lattice);

/// Shirley and Tuchman's triangles: three around the inner point or four around where two edges cross, which is
/// `thickest`, in pixels; their outer edges moved outwards likewise. A cell that is all too
/// narrow gets what outline_of gives it.
Outline fan_of(const VisibleCell& cell, const glm::dvec2& thickest, const RasterLattice& lattice);

} // namespace visorder::detail
