#pragma once

#include "optics/optical_pieces.h"
#include "projection/scaled_scalars.h"
#include "projection/screen.h"
#include "projection/visible_cells.h"

#include <glm/vec4.hpp>
#include <span>

namespace visorder::detail {

/// What cells' triangles are made from. All of it must outlive what is made.
struct TriangleSources {
    const Screen* screen;
    const VisibleCells* cells;
    ScaledScalars scalars;
    std::span<const glm::vec4> optics; ///< colour and extinction at each point; only where vertices are interpolated
    bool opacity_at_thickest = false;  ///< whether the fourth component interpolated is opacity, not extinction
    const OpticalPieces* pieces;       ///< where they are integrated exactly, else null
};

/// Whether a cell's ways, as far as they can be told from `pieces`, may be integrated exactly by fragments that look up
/// scalars in single precision: see looked_up_in_single_precision.
bool single_precision_is_enough(const VisibleCell& cell, const TriangleSources& from);

} // namespace visorder::detail
