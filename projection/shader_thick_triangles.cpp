#include "projection/shader_thick_triangles.h"

namespace visorder {

std::size_t ShaderThickTriangles::make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                                       std::vector<CellOffLattice>& off_lattice) const
{
    constexpr std::size_t most_a_cell = 5;
    into.resize(cells.size() * most_a_cell * record_bytes());
    auto* const first = reinterpret_cast<ThickRecord*>(into.data());
    ThickRecord* next = first;
    const auto put = [&](ThickRecord record, std::uint32_t kind) {
        record[0] |= kind << thick_record_kinds::shift;
        *next++ = record;
    };
    from_.cells->visit_candidates(
        cells,
        [&](CellId cell, const std::uint32_t* v, const std::array<glm::ivec2, 4>&) {
            visit_with_slabs(
                from_, cell,
                [&](const BoundarySlab& slab) {
                    put({slab.face[0], slab.face[1], slab.face[2], slab.face[2]},
                        slab.entry ? thick_record_kinds::entry_slab : thick_record_kinds::exit_slab);
                },
                [&] {
                    put({v[0], v[1], v[2], v[3]},
                        from_.cells->turned(cell) ? thick_record_kinds::turned_cell : thick_record_kinds::cell);
                });
        },
        [&](CellId cell) {
            off_lattice.push_back({static_cast<std::uint32_t>(next - first), cell});
        });
    return static_cast<std::size_t>(next - first);
}

} // namespace visorder
