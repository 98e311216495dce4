#pragma once

#include "projection/record_sink.h"
#include "visorder/mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace visorder::detail {

/// A cell that no triangles stand for (see VisibleCells), and how many records stand before it.
struct CellApart {
    std::uint32_t records_before;
    CellId cell;
};

/// What a projector makes of cells, in the form that its vertex shader reads: records in sequence, each of some number
/// of bytes, for one triangle or some. Threads may share one.
class CellTriangles {
public:
    virtual ~CellTriangles() = default;

    virtual std::size_t record_bytes() const = 0;
    virtual std::size_t triangles_a_record() const { return 1; }

    /// How many vectors of four floats the vertex shader takes of a vertex, as attributes 0, 1, ..., 16 bytes apart;
    /// vertices are a third of record_bytes() apart. 0: it reads the records as a storage buffer.
    virtual int vertex_attributes() const = 0;

    /// The records of the cells (inner numbering) in their sequence. Cells set apart get none, and are listed.
    virtual void make(std::span<const CellId> cells, RecordSink& into, std::vector<CellApart>& apart) const = 0;
};

} // namespace visorder::detail
