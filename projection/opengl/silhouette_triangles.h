#pragma once

#include "projection/opengl/silhouette_layout.h"
#include "projection/triangle_sources.h"

namespace visorder::detail {

/// The triangles of Projector::silhouette and Projector::thick: of each triangle of a cell's outline, or of Shirley and
/// Tuchman's fan around its thickest point, the cell's Thickness, as the shader reads it. Where the integrator is
/// exact, one for each of the cell's OpticalPasses, pass by pass.
///
/// All of it is linear on Shirley and Tuchman's triangles, and so a fragment knows it wherever the rasteriser has the
/// triangles' corners.
class SilhouetteTriangles final : public CellTriangles {
public:
    /// `fans`: whether to draw fans rather than outlines.
    SilhouetteTriangles(const TriangleSources& sources, Integrator integrator, bool fans);

    std::size_t record_bytes() const override { return layout_.triangle_bytes(); }
    int vertex_attributes() const override { return layout_.vertex_attributes(); }
    void make(std::span<const CellId> cells, RecordSink& into, std::vector<CellApart>& apart) const override;

private:
    struct Writer;

    TriangleSources from_;
    SilhouetteLayout layout_;
    bool fans_;
    bool linear_;
    bool perspective_;
    double inverse_distance_;
    double longest_ray_; // distance over depth, where it is most in the image
};

} // namespace visorder::detail
