#pragma once

#include "projection/visible_cells.h"

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>

namespace visorder {

/// Triangles with their corners on the rasteriser's lattice, in lattice steps, that cover each pixel once.
class Outline {
public:
    using Triangle = std::array<glm::ivec2, 3>;

    void add(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) { triangles_[count_++] = {a, b, c}; }
    std::span<const Triangle> triangles() const { return {triangles_.data(), count_}; }

private:
    std::array<Triangle, 4> triangles_{};
    std::size_t count_ = 0;
};

/// The corners of a cell's silhouette, moved outwards so far that what they enclose holds all of it, wherever rounding
/// to the lattice takes them: points 1 to 3 of a triangle, and of a quad points 0, 2, 1 and 3, in a round. None where
/// one would go far.
struct MovedCorners {
    std::array<glm::ivec2, 4> at;
    std::size_t count;
};
std::optional<MovedCorners> moved_corners(const VisibleCell& cell, const RasterLattice& lattice);

/// One triangle or two around a cell's silhouette, little larger. Thickness is zero where the cell is not.
Outline outline_of(const VisibleCell& cell, const RasterLattice& lattice);

/// Shirley and Tuchman's triangles: three around the inner point or four around where two edges cross, which is
/// `thickest`, in pixels; their outer edges moved outwards likewise.
Outline fan_of(const VisibleCell& cell, const glm::dvec2& thickest, const RasterLattice& lattice);

} // namespace visorder
