#pragma once

#include "projection/cell_triangles.h"
#include "projection/optical_pieces.h"
#include "projection/screen.h"
#include "projection/visible_cells.h"
#include "scene/adjacency.h"
#include "scene/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder {

/// What cells' triangles are made from, beside the cells. All of it must outlive what is made.
struct TriangleSources {
    const Scene* scene;
    const Screen* screen;
    const VisibleCells* cells;
    RasterLattice lattice;
    std::span<const glm::vec4> optics; ///< colour and extinction at each point; only where vertices are interpolated
    bool opacity_at_thickest = false;  ///< whether the fourth component interpolated is opacity, not extinction
    const OpticalPieces* pieces = nullptr; ///< the transfer function; only where what is integrated is cut by it
};

/// The way between a boundary face with its corners on the rasteriser's lattice and the same face where it is. Inside a
/// mesh such displacements cancel, for both cells at a face see the same; at its boundary they would make a ray's way
/// through the mesh longer or shorter, the more so the steeper the face.
struct BoundarySlab {
    std::array<PointId, 3> face;
    std::array<glm::ivec2, 3> at;  ///< in lattice steps
    std::array<double, 3> depth;   ///< projective, of the face on the lattice
    std::array<double, 3> missing; ///< how much deeper the face is there in fact
    std::array<double, 3> scalar;  ///< each multiplied by 1 - depth / D
    bool entry;                    ///< whether rays enter the mesh there
};

/// The slabs of a cell's boundary faces that cover the centre of a pixel: of those where rays enter the mesh, or of
/// those where they leave it. None of a face so steep that it is displaced by as much as it is wide.
std::vector<BoundarySlab> boundary_slabs(const TriangleSources& from, CellId cell, bool entries);

/// Calls `put_slab` for the slabs behind a cell, `put_cell()`, and `put_slab` for the slabs before it.
template <class PutSlab, class PutCell>
void visit_with_slabs(const TriangleSources& from, CellId cell, PutSlab&& put_slab, PutCell&& put_cell)
{
    constexpr std::uint8_t all_faces = 15;
    // Opacity between vertices is not that of a length, so no length can be made good.
    const bool slabs = from.scene->adjacency().interior[cell] != all_faces && !from.opacity_at_thickest;
    if (slabs)
        for (const BoundarySlab& slab : boundary_slabs(from, cell, false))
            put_slab(slab);
    put_cell();
    if (slabs)
        for (const BoundarySlab& slab : boundary_slabs(from, cell, true))
            put_slab(slab);
}

/// Has a writer put cells and their slabs, in this order, and lists the cells that are off the lattice; returns how
/// many triangles the writer put. It has `put_slab(slab)`, `put_cell(cell)` and `count`.
template <class Writer>
std::size_t put_cells_with_slabs(const TriangleSources& from, std::span<const CellId> cells, Writer&& writer,
                                 std::vector<CellOffLattice>& off_lattice)
{
    from.cells->visit(
        cells,
        [&](const VisibleCell& cell) {
            visit_with_slabs(
                from, cell.cell, [&](const BoundarySlab& slab) { writer.put_slab(slab); },
                [&] { writer.put_cell(cell); });
        },
        [&](CellId cell) {
            off_lattice.push_back({static_cast<std::uint32_t>(writer.count), cell});
        });
    return writer.count;
}

/// The gradient over the screen of what is linear on a triangle.
glm::dvec2 slope_of(const std::array<glm::dvec2, 3>& corners, const std::array<double, 3>& value);

} // namespace visorder
