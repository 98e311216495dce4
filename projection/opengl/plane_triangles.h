#pragma once

#include "projection/triangle_sources.h"

namespace visorder::detail {

/// The triangles of Projector::planes: of each triangle of a cell's outline the planes of all its faces, as the shader
/// reads them. A ray enters where it has passed all those that it enters through, and leaves at the first of the
/// others.
class PlaneTriangles final : public CellTriangles {
public:
    explicit PlaneTriangles(const TriangleSources& sources) : from_(sources) {}

    std::size_t record_bytes() const override;
    int vertex_attributes() const override { return 0; }
    void make(std::span<const CellId> cells, RecordSink& into, std::vector<CellApart>& apart) const override;

private:
    struct Writer;

    TriangleSources from_;
};

} // namespace visorder::detail
