#pragma once

#include "projection/thickness.h"

#include <span>

namespace visorder {

/// What cells' triangles are made from, beside the cells. All of it must outlive what is made.
struct TriangleSources {
    const Scene* scene;
    const Screen* screen;
    const VisibleCells* cells;
    RasterLattice lattice;
    std::span<const glm::vec4> optics; ///< colour and extinction at each point; only where vertices are interpolated
    bool opacity_at_thickest = false;  ///< whether the fourth component interpolated is opacity, not extinction
};

/// The triangles of Projector::silhouette: of each half of a cell's silhouette the cell's Thickness, as the shader reads
/// it.
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

/// The optics of a cell's points and of its thickest point, as the integrators linear and exponential have them: colour
/// averaged between front and back, and averaged extinction or the opacity that comes of it.
struct CellOptics {
    std::array<glm::vec4, 4> at_points;
    glm::vec4 at_thickest;
};
CellOptics optics_of(const TriangleSources& from, const VisibleCell& cell, const ThickPoint& point);

} // namespace visorder
