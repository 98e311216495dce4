#pragma once

#include "projection/cell_triangles.h"
#include "projection/screen_points.h"
#include "projection/silhouette.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <span>

namespace visorder::detail {

/// A tetrahedron that covers the centre of a pixel, or may.
struct VisibleCell {
    CellId cell;
    SilhouetteClass kind; ///< triangle or quad
    /// Of a triangle, the inner point and the three around it; of a quad, the ends of the nearer edge and then those of
    /// the farther, of either edge first the one that is farther off the other edge's line.
    std::array<PointId, 4> points;
    std::array<glm::dvec3, 4> at; ///< where they are: see ScreenPoints
    glm::ivec2 low, high;         ///< a box around them, in lattice steps
    double longest;               ///< pixels along either axis from the first to another one
    double nearest, farthest;     ///< depths
    std::array<double, 4> areas;  ///< see Silhouette, whose areas these are, in pixels
    bool counterclockwise;        ///< likewise
    bool inner_behind;            ///< of a triangle: whether the inner point is behind the other three
    /// Pixels: a face narrower than this, seen almost edge-on, is as good as one of this width, for no pixel's centre
    /// is that close to it.
    double least_width;
};

/// Finds out which cells are seen, and how they lie. What covers no pixel's centre is left out: most, of a large mesh.
///
/// Where a face is seen almost edge-on, the length of a ray's way through the cell is known only if the face is not all
/// too narrow: fragments know where on the way along a cell's thickness they are up to an error, times the width of a
/// face that is seen almost edge-on, of 8 l^2 / 2^47 in a cell that is l pixels long (see SplitLinear). Where a pixel's
/// centre lies in a face so narrow that this would be more than a few millionths of the scene's diameter, or two
/// millionths of the cell's thickness, the cell is set apart.
///
/// Holds references to what it is made from. Threads may share one.
class VisibleCells {
public:
    /// `turned`: of each cell, whether its vertices stand in the reverse of VTK's order (1) or not (0).
    VisibleCells(const Scene& scene, std::span<const std::uint8_t> turned, const ScreenPoints& points,
                 const Screen& screen, const RasterLattice& lattice);

    /// The pixels of the image with their centres in a box, both ends of which count: first and last, from the image's
    /// centre. Corners in lattice steps. None if the first is beyond the last.
    struct Pixels {
        glm::ivec2 first, last;
        bool none() const { return first.x > last.x || first.y > last.y; }
    };
    Pixels pixels_in(const glm::ivec2& low, const glm::ivec2& high) const;

    /// Whether the box around a triangle, corners in lattice steps, holds the centre of a pixel of the image.
    bool may_cover(const std::array<glm::ivec2, 3>& triangle) const;

    /// Calls `visible(VisibleCell)` for cells (inner numbering) in their sequence, and `apart(cell)` for those of which
    /// a point is off the lattice, and those that are too large or not seen well enough.
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
        double longest;     ///< no side of the silhouette is longer
    };
    Precision precision_for(VisibleCell& cell) const;
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
    double length_scale_; // of a difference of depths: how far, in tolerances, rays go
    bool mirrored_;
};

template <class Visible, class Apart>
void VisibleCells::visit(std::span<const CellId> cells, Visible&& visible, Apart&& apart) const
{
    constexpr std::size_t ahead = 12;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i + ahead < cells.size()) {
            // In a function of its own, it would not count: it seems to do nothing.
            __builtin_prefetch(vertices_.data() + std::size_t{cells[i + ahead]} * 4);
            for (const std::uint32_t vertex : vertices_.subspan(std::size_t{cells[i + ahead / 2]} * 4, 4)) {
                __builtin_prefetch(&points_.snapped[vertex]);
                __builtin_prefetch(&points_.at[vertex]);
            }
        }
        const CellId cell = cells[i];
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
        const glm::ivec2 low = glm::min(glm::min(at[0], at[1]), glm::min(at[2], at[3])) - 1;
        const glm::ivec2 high = glm::max(glm::max(at[0], at[1]), glm::max(at[2], at[3])) + 1;
        if (pixels_in(low, high).none())
            continue;
        VisibleCell seen; // all of it is set where the cell is seen
        seen.cell = cell;
        seen.low = low;
        seen.high = high;
        const Sight sight = complete(seen, v);
        if (sight == Sight::clear)
            visible(seen);
        else if (sight == Sight::apart)
            apart(cell);
    }
}

} // namespace visorder::detail
