#pragma once

#include "projection/boundary_slab.h"
#include "projection/silhouette_layout.h"

namespace visorder {

/// The triangles of Projector::silhouette: of each half of a cell's silhouette the cell's Thickness, as the shader
/// reads it. Where the integrator is exact, one triangle for each of the cell's OpticalPasses.
///
/// All is linear on triangles whose corners are on the lattice, where neighbours agree on it. What that displaces the
/// mesh's boundary by is made good by thin slabs: beside a cell with a boundary face stands a triangle for the way
/// between that face on the lattice and where it is.
class SilhouetteTriangles final : public CellTriangles {
public:
    SilhouetteTriangles(const TriangleSources& sources, Integrator integrator);

    std::size_t record_bytes() const override { return layout_.triangle_bytes(); }
    int vertex_attributes() const override { return layout_.vertex_attributes(); }
    std::size_t make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                     std::vector<CellOffLattice>& off_lattice) const override;

private:
    struct Writer;

    TriangleSources from_;
    SilhouetteLayout layout_;
    bool perspective_;
    double pixels_a_step_;
    double inverse_distance_;
    double longest_ray_; // distance over depth, where it is most in the image
};

} // namespace visorder
