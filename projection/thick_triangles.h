#pragma once

#include "projection/boundary_slab.h"

namespace visorder {

/// The triangles of Projector::thick: Shirley and Tuchman's, three or four around the thickest point of a cell, with
/// the depths and scalars of entry and exit at each corner, in the form in which they are linear on the screen.
class ThickTriangles final : public CellTriangles {
public:
    explicit ThickTriangles(const TriangleSources& sources) : from_(sources) {}

    std::size_t record_bytes() const override;
    int vertex_attributes() const override { return from_.optics.empty() ? 2 : 3; }
    std::size_t make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                     std::vector<CellOffLattice>& off_lattice) const override;

private:
    struct Writer;

    TriangleSources from_;
};

} // namespace visorder
