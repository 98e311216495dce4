#pragma once

#include "projection/triangle_sources.h"

namespace visorder {

/// The triangles of Projector::silhouette and Projector::thick: of each triangle of a cell's outline, or of Shirley and
/// Tuchman's fan around its thickest point, the cell's Thickness, as the shader reads it.
///
/// All of it is linear on Shirley and Tuchman's triangles, and so a fragment knows it wherever the rasteriser has the
/// triangles' corners.
class SilhouetteTriangles final : public CellTriangles {
public:
    /// `fans`: whether to draw fans rather than outlines.
    SilhouetteTriangles(const TriangleSources& sources, bool fans);

    std::size_t triangle_bytes() const override;
    std::size_t most_a_cell() const override { return fans_ ? 4 : 2; }
    std::size_t make(std::span<const CellId> cells, std::byte* into, std::vector<CellApart>& apart) const override;

private:
    struct Writer;

    TriangleSources from_;
    bool fans_;
};

} // namespace visorder
