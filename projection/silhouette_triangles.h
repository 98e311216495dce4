#pragma once

#include "projection/boundary_slab.h"

namespace visorder {

/// The triangles of Projector::silhouette: of each half of a cell's silhouette the cell's Thickness, as the shader
/// reads it.
///
/// All is linear on triangles whose corners are on the lattice, where neighbours agree on it. What that displaces the
/// mesh's boundary by is made good by thin slabs: beside a cell with a boundary face stands a triangle for the way
/// between that face on the lattice and where it is.
class SilhouetteTriangles final : public CellTriangles {
public:
    explicit SilhouetteTriangles(const TriangleSources& sources);

    std::size_t triangle_bytes() const override;
    std::size_t most_a_cell() const override { return 6; }
    std::size_t make(std::span<const CellId> cells, std::byte* into,
                     std::vector<CellOffLattice>& off_lattice) const override;

private:
    struct Writer;

    TriangleSources from_;
    double pixels_a_step_;
    double inverse_distance_;
};

} // namespace visorder
