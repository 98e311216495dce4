#pragma once

#include "visorder/transfer_function.h"

#include <cstdint>
#include <glm/vec4.hpp>
#include <vector>

namespace visorder::detail {

/// A transfer function cut into pieces on which extinction and colour are linear, over a scalar that is shifted and
/// scaled: what shaders and tables read.
struct OpticalPieces {
    /// A piece from `begin` up to `end`; values at `begin`, and how much they rise per unit of the scalar.
    struct Piece {
        double begin, end;
        double extinction, extinction_slope;
        glm::vec4 colour, colour_slope; ///< the fourth components are 0
    };
    /// Ascending; each ends where the next begins. The first begins and the last ends beyond any scalar.
    std::vector<Piece> pieces;
    /// Of equal parts of [0, 1], the piece in which each begins: where to start looking for a scalar's.
    std::vector<std::int32_t> first_piece;

    /// The piece that holds a scalar; at a jump the one above.
    const Piece& at(double scalar) const;
};

/// `lowest` becomes 0 and `lowest + range` 1; `range` is above 0.
OpticalPieces optical_pieces(const TransferFunction& function, double lowest, double range);

/// The same in single precision, as shaders read it. What is too narrow for that is a jump.
struct NarrowedPieces {
    struct Piece {
        float begin, end;
        float extinction, extinction_slope;
        glm::vec4 colour, colour_slope;
    };
    std::vector<Piece> pieces;
    std::vector<std::int32_t> first_piece;
};

NarrowedPieces narrowed(const OpticalPieces& pieces);

} // namespace visorder::detail
