#pragma once

#include "projection/triangle_sources.h"

namespace visorder::detail {

/// The cells of Projector::thick_gpu: their points, of which the vertex shader (see thick_vertex_shader) makes the same
/// triangles as SilhouetteTriangles makes of fans. Here it is only found out which are seen, and how they lie.
class ShaderThickTriangles final : public CellTriangles {
public:
    explicit ShaderThickTriangles(const TriangleSources& sources) : from_(sources) {}

    std::size_t record_bytes() const override;
    std::size_t triangles_a_record() const override { return 4; }
    int vertex_attributes() const override { return 0; }
    void make(std::span<const CellId> cells, RecordSink& into, std::vector<CellApart>& apart) const override;

private:
    TriangleSources from_;
};

} // namespace visorder::detail
