#pragma once

#include "projection/boundary_slab.h"

#include <array>
#include <cstdint>

namespace visorder {

/// What the vertex shader of Projector::thick_gpu makes four triangles from: the points of a cell in its order or of a
/// BoundarySlab, and in the two highest bits of the first which of these.
using ThickRecord = std::array<std::uint32_t, 4>;

namespace thick_record_kinds {
inline constexpr std::uint32_t cell = 0;
inline constexpr std::uint32_t turned_cell = 1;
inline constexpr std::uint32_t entry_slab = 2; ///< three points
inline constexpr std::uint32_t exit_slab = 3;
inline constexpr std::uint32_t shift = 30;
} // namespace thick_record_kinds

/// The cells of Projector::thick_gpu, whose triangles are those of ThickTriangles. They are classified and decomposed
/// by the vertex shader; here it is only found out which may cover a pixel's centre.
class ShaderThickTriangles final : public CellTriangles {
public:
    explicit ShaderThickTriangles(const TriangleSources& sources) : from_(sources) {}

    std::size_t record_bytes() const override { return sizeof(ThickRecord); }
    std::size_t triangles_a_record() const override { return 4; }
    int vertex_attributes() const override { return 0; }
    std::size_t make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                     std::vector<CellOffLattice>& off_lattice) const override;

private:
    TriangleSources from_;
};

} // namespace visorder
