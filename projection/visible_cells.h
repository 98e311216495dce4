#pragma once

#include "projection/cell_triangles.h"
#include "projection/screen_points.h"
#include "projection/silhouette.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace visorder {

/// A tetrahedron that covers the centre of a pixel, or may.
struct VisibleCell {
    CellId cell;
    SilhouetteClass kind; ///< triangle or quad
    /// Of a triangle, the inner point and the three around it; of a quad, the ends of the nearer edge and then those of
    /// the farther.
    std::array<PointId, 4> points;
    std::array<glm::ivec2, 4> at; ///< where they are, in lattice steps
    bool inner_behind;            ///< of a triangle: whether the inner point is behind the other three
    /// Of a quad: whether the triangle of the nearer edge and the third point, and that with the fourth, cover a
    /// centre. Of a triangle: true, false.
    bool first_half, second_half;
};

/// Finds out which cells are seen, and how they lie. What covers no pixel's centre is left out: most, of a large mesh.
/// Holds references to what it is made from. Threads may share one.
class VisibleCells {
public:
    /// `turned`: of each cell, whether its vertices stand in the reverse of VTK's order (1) or not (0).
    VisibleCells(const Scene& scene, std::span<const std::uint8_t> turned, const ScreenPoints& points,
                 const Screen& screen, const RasterLattice& lattice);

    /// Whether the closed triangle holds the centre of a pixel of the image. True where that takes long to find out.
    bool covers_a_centre(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) const;

    /// Calls `visible(VisibleCell)` for cells (inner numbering) in their sequence, and `off_lattice(cell)` for those of
    /// which a point is off the lattice.
    template <class Visible, class OffLattice>
    void visit(std::span<const CellId> cells, Visible&& visible, OffLattice&& off_lattice) const;

    /// The same without a closer look: calls `seen(cell, its four points, where they are in lattice steps)` for cells
    /// whose extent holds the centre of a pixel.
    template <class Seen, class OffLattice>
    void visit_candidates(std::span<const CellId> cells, Seen&& seen, OffLattice&& off_lattice) const;

    const ScreenPoints& points() const { return points_; }
    /// Whether a cell's vertices stand, as seen, in the reverse of VTK's order.
    bool turned(CellId cell) const { return (turned_[cell] != 0) != mirrored_; }

private:
    bool complete(VisibleCell& cell, const Silhouette& silhouette, const std::uint32_t* v,
                  const std::array<glm::ivec2, 4>& at) const;

    std::span<const std::uint32_t> vertices_;
    std::span<const std::uint8_t> turned_;
    const ScreenPoints& points_;
    glm::ivec2 first_, last_; // the image's pixels, from its centre
    int half_step_;           // a pixel's corner to its centre, in lattice steps
    int shift_;               // a pixel is 2^shift_ lattice steps
    bool mirrored_;
};

template <class Visible, class OffLattice>
void VisibleCells::visit(std::span<const CellId> cells, Visible&& visible, OffLattice&& off_lattice) const
{
    visit_candidates(
        cells,
        [&](CellId cell, const std::uint32_t* v, const std::array<glm::ivec2, 4>& at) {
            VisibleCell seen{};
            seen.cell = cell;
            if (complete(seen, silhouette_of(at), v, at))
                visible(seen);
        },
        off_lattice);
}

template <class Seen, class OffLattice>
void VisibleCells::visit_candidates(std::span<const CellId> cells, Seen&& seen, OffLattice&& off_lattice) const
{
    const int mask = (1 << shift_) - 1;
    for (const CellId cell : cells) {
        const std::uint32_t* v = vertices_.data() + std::size_t{cell} * 4;
        const std::array<std::uint8_t, 4> sides{points_.sides[v[0]], points_.sides[v[1]], points_.sides[v[2]],
                                                points_.sides[v[3]]};
        if ((sides[0] & sides[1] & sides[2] & sides[3] & sides::all) != 0)
            continue;
        if (((sides[0] | sides[1] | sides[2] | sides[3]) & sides::off_lattice) != 0) {
            off_lattice(cell);
            continue;
        }
        const std::array<glm::ivec2, 4> at{points_.snapped[v[0]], points_.snapped[v[1]], points_.snapped[v[2]],
                                           points_.snapped[v[3]]};
        const glm::ivec2 low = glm::min(glm::min(at[0], at[1]), glm::min(at[2], at[3])) - half_step_;
        const glm::ivec2 high = glm::max(glm::max(at[0], at[1]), glm::max(at[2], at[3])) - half_step_;
        // Between the lowest and the highest there must be the centre of a pixel.
        if ((low.x + mask) >> shift_ > high.x >> shift_ || (low.y + mask) >> shift_ > high.y >> shift_)
            continue;
        seen(cell, v, at);
    }
}

} // namespace visorder
