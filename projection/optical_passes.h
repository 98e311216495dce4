#pragma once

#include "optics/optical_pieces.h"

#include <glm/vec4.hpp>
#include <vector>

namespace visorder::detail {

/// A part of the ways through a cell on which extinction and colour are linear and optical depth is small: what a
/// fragment integrates without looking anything up. Scalars are relative to CellWays::reference.
struct OpticalPass {
    glm::vec4 medium; ///< extinction and colour at the reference
    glm::vec4 rise;   ///< their rise per unit of the scalar

    /// Of a ray's way from Thickness' one side to the other, cut into window.z parts, that with the number window.w,
    /// and of that, what runs from scalar window.x to window.y: of a ray along which the scalar runs the other way,
    /// nothing. All of the part if the two are equal.
    glm::vec4 window;
};

/// The ways of all rays through a cell.
struct CellWays {
    double lowest, highest; ///< scalars
    double reference;       ///< a scalar between
    double longest;         ///< at least as long as any
    bool rises, falls;      ///< whether the scalar does, along some ray, from Thickness' one side to the other, or may
    bool swapped;           ///< see Thickness
};

/// Fragments know in single precision where on a way they are. Where more than this optical depth may lie along it,
/// that is not enough.
constexpr double most_depth_in_single_precision = 16;

/// Replaces `passes` by those of a cell, farthest first along each ray. Parts without extinction have none. False, and
/// no passes, if the cell is too dense for single precision.
bool find_optical_passes(const OpticalPieces& pieces, const CellWays& ways, std::vector<OpticalPass>& passes);

/// Whether single precision is enough along ways through a cell even where scalars are given in it, and not relative to
/// a scalar of the cell: where extinction changes abruptly, it is not.
bool looked_up_in_single_precision(const OpticalPieces& pieces, double lowest, double highest, double longest);

} // namespace visorder::detail
