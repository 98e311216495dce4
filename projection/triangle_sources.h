#pragma once

#include "projection/optical_pieces.h"
#include "projection/screen.h"
#include "projection/visible_cells.h"

#include <glm/vec4.hpp>
#include <span>

namespace visorder {

/// What cells' triangles are made from. All of it must outlive what is made.
struct TriangleSources {
    const Screen* screen;
    const VisibleCells* cells;
    std::span<const float> scalars;
    std::span<const glm::vec4> optics; ///< colour and extinction at each point; only where vertices are interpolated
    bool opacity_at_thickest = false;  ///< whether the fourth component interpolated is opacity, not extinction
    const OpticalPieces* pieces;       ///< where triangles are cut into OpticalPasses, else null
};

} // namespace visorder
