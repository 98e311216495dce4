#include "projection/plane_triangles.h"

namespace visorder {

std::size_t PlaneTriangles::make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                                 std::vector<CellOffLattice>& off_lattice) const
{
    constexpr std::size_t most_a_cell = 2;
    into.resize(cells.size() * most_a_cell * record_bytes());
    auto* const first = reinterpret_cast<PlaneRecord*>(into.data());
    PlaneRecord* next = first;
    const auto put = [&](const VisibleCell& cell, std::uint32_t kind) {
        *next = cell.points;
        (*next++)[0] |= kind << record_kinds::shift;
    };
    cells_.visit(
        cells,
        [&](const VisibleCell& cell) {
            if (cell.kind == SilhouetteClass::triangle) {
                put(cell, cell.inner_behind ? record_kinds::inner_behind : record_kinds::inner_before);
                return;
            }
            if (cell.first_half)
                put(cell, record_kinds::quad_third);
            if (cell.second_half)
                put(cell, record_kinds::quad_fourth);
        },
        [&](CellId cell) {
            off_lattice.push_back({static_cast<std::uint32_t>(next - first), cell});
        });
    return static_cast<std::size_t>(next - first);
}

} // namespace visorder
