#pragma once

#include "projection/cell_triangles.h"
#include "projection/screen_points.h"
#include "projection/silhouette.h"
#include "scene/scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <span>

namespace visorder {

/// A tetrahedron that covers the centre of a pixel, or may.
struct VisibleCell {
    CellId cell;
    SilhouetteClass kind; ///< triangle or quad
    /// Of a triangle, the inner point and the three around it; of a quad, the ends of the nearer edge and then those of
    /// the farther, of either edge first the one that is farther off the other edge's line.
    std::array<PointId, 4> points;
    std::array<glm::dvec3, 4> at; ///< where they are: see ScreenPoints
    bool inner_behind;            ///< of a triangle: whether the inner point is behind the other three
    /// Pixels: a face narrower than this, seen almost edge-on, is as good as one of this width, for no pixel's centre
    /// is that close to it.
    double least_width;
};

/// Finds out which cells are seen, and how they lie. What covers no pixel's centre is left out: most, of a large mesh.
///
/// Single precision can tell where a ray passes a face that is seen almost edge-on only if the face is not all too
/// narrow: where it is w wide, and the cell as many as l long and t thick, the length of the way through the cell is
/// known to some t l / w in 2^24. Where a pixel's centre lies in such a face, and that would be more than a few
/// millionths of the scene's diameter, the cell is set apart.
///
/// Holds references to what it is made from. Threads may share one.
class VisibleCells {
public:
    /// `turned`: of each cell, whether its vertices stand in the reverse of VTK's order (1) or not (0).
    VisibleCells(const Scene& scene, std::span<const std::uint8_t> turned, const ScreenPoints& points,
                 const Screen& screen, const RasterLattice& lattice);

    /// Whether the closed triangle, corners in lattice steps, holds the centre of a pixel of the image. True where that
    /// takes long to find out.
    bool covers_a_centre(const std::array<glm::ivec2, 3>& triangle) const;

    /// Calls `visible(VisibleCell)` for cells (inner numbering) in their sequence, and `apart(cell)` for those of which
    /// a point is off the lattice, and those for which single precision is not enough.
    template <class Visible, class Apart>
    void visit(std::span<const CellId> cells, Visible&& visible, Apart&& apart) const;

    const RasterLattice& lattice() const { return lattice_; }

private:
    enum class Sight : std::uint8_t { none, clear, apart };

    Sight complete(VisibleCell& cell, const std::uint32_t* v) const;
    Sight judge(VisibleCell& cell) const;
    struct Precision {
        double wide_enough; ///< pixels: a face as wide is seen well; infinite: none is
        double beside;      ///< pixels: so far beside a narrow face it does not matter
    };
    Precision precision_for(const VisibleCell& cell) const;
    bool centre_near(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& third, double distance) const;
    /// Whether a cell's vertices stand, as seen, in the reverse of VTK's order.
    bool turned(CellId cell) const { return (turned_[cell] != 0) != mirrored_; }

    std::span<const std::uint32_t> vertices_;
    std::span<const std::uint8_t> turned_;
    const ScreenPoints& points_;
    RasterLattice lattice_;
    glm::ivec2 first_, last_; // the image's pixels, from its centre
    int half_step_;           // a pixel's corner to its centre, in lattice steps
    int shift_;               // a pixel is 2^shift_ lattice steps
    double inverse_distance_;
    double width_scale_;
    bool mirrored_;
};

template <class Visible, class Apart>
void VisibleCells::visit(std::span<const CellId> cells, Visible&& visible, Apart&& apart) const
{
    const int mask = (1 << shift_) - 1;
    for (const CellId cell : cells) {
        const std::uint32_t* v = vertices_.data() + std::size_t{cell} * 4;
        const std::array<std::uint8_t, 4> sides{points_.sides[v[0]], points_.sides[v[1]], points_.sides[v[2]],
                                                points_.sides[v[3]]};
        if ((sides[0] & sides[1] & sides[2] & sides[3] & sides::all) != 0)
            continue;
        if (((sides[0] | sides[1] | sides[2] | sides[3]) & sides::off_lattice) != 0) {
            apart(cell);
            continue;
        }
        const std::array<glm::ivec2, 4> at{points_.snapped[v[0]], points_.snapped[v[1]], points_.snapped[v[2]],
                                           points_.snapped[v[3]]};
        // Rounded, they may be a step too close.
        const glm::ivec2 low = glm::min(glm::min(at[0], at[1]), glm::min(at[2], at[3])) - half_step_ - 1;
        const glm::ivec2 high = glm::max(glm::max(at[0], at[1]), glm::max(at[2], at[3])) - half_step_ + 1;
        // Between the lowest and the highest there must be the centre of a pixel.
        if ((low.x + mask) >> shift_ > high.x >> shift_ || (low.y + mask) >> shift_ > high.y >> shift_)
            continue;
        VisibleCell seen{};
        seen.cell = cell;
        const Sight sight = complete(seen, v);
        if (sight == Sight::clear)
            visible(seen);
        else if (sight == Sight::apart)
            apart(cell);
    }
}

} // namespace visorder
