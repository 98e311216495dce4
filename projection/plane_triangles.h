#pragma once

#include "projection/visible_cells.h"

#include <array>
#include <cstdint>

namespace visorder {

/// One triangle of a cell's silhouette: the cell's four points, arranged so that a fragment can tell which faces its
/// ray passes through, and in the two highest bits of the first how.
using PlaneRecord = std::array<std::uint32_t, 4>;

/// What the two highest bits of a record say. Of a silhouette that is a triangle, the first point is the inner one, and
/// the triangle drawn is that of the others; of a quad, the first two points are the ends of the nearer edge, the other
/// two those of the farther, and the triangle drawn is that of the first two and one of the others.
namespace record_kinds {
inline constexpr std::uint32_t inner_behind = 0; ///< the inner point is behind the face of the other three
inline constexpr std::uint32_t inner_before = 1;
inline constexpr std::uint32_t quad_third = 2;
inline constexpr std::uint32_t quad_fourth = 3;
inline constexpr std::uint32_t shift = 30;
} // namespace record_kinds

/// The triangles of Projector::planes, as PlaneRecords.
class PlaneTriangles final : public CellTriangles {
public:
    explicit PlaneTriangles(const VisibleCells& cells) : cells_(cells) {}

    std::size_t record_bytes() const override { return sizeof(PlaneRecord); }
    int vertex_attributes() const override { return 0; }
    std::size_t make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                     std::vector<CellOffLattice>& off_lattice) const override;

private:
    const VisibleCells& cells_;
};

} // namespace visorder
