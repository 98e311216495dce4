#pragma once

#include "graphics/program.h"
#include "optics/optical_pieces.h"
#include "visorder/renderer.h"

#include <cstddef>

namespace visorder::detail {

/// How long ways through the cells of a scene are.
struct WayLengths {
    double mean;    ///< along random lines
    double longest; ///< or more
};

/// What an integrator's shader reads of a transfer function. Its context must be current where it is made and used.
class FunctionTextures {
public:
    /// Throws InputError for tables of fewer than 2 entries a side, or more than the renderer can hold.
    FunctionTextures(const Context& context, Integrator integrator, const TableOptions& options,
                     const WayLengths& lengths);

    /// Computes what the integrator needs.
    void set(const OpticalPieces& pieces);

    /// Tells a program where it all is. `pieces`: whether the program reads the pieces.
    void introduce(Program& program, bool pieces) const;

    void bind() const;

private:
    const Context* context_;
    Integrator integrator_;
    TableOptions options_;
    WayLengths lengths_;
    double length_scale_ = 1;
    GlObject pieces_in_doubles_;
    GlObject pieces_buffer_, pieces_;
    GlObject first_piece_buffer_, first_piece_;
    GlObject table_;
};

} // namespace visorder::detail
