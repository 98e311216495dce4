#pragma once

#include "projection/cell_triangles.h"
#include "projection/screen_points.h"
#include "scene/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace visorder {

/// One triangle of a cell's silhouette: the cell's four points, arranged so that a fragment can tell which faces its
/// ray passes through, and in the two highest bits of the first how.
using TriangleRecord = std::array<std::uint32_t, 4>;

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

/// The triangles of cells' silhouettes, as TriangleRecords. Those that cover no pixel's centre are left out: most, of a
/// large mesh. Holds references to what it is made from.
class SilhouetteTriangles final : public CellTriangles {
public:
    /// `turned`: of each cell, whether its vertices stand in the reverse of VTK's order as seen (1) or not (0).
    SilhouetteTriangles(const Scene& scene, std::span<const std::uint8_t> turned, const ScreenPoints& points,
                        const Screen& screen, const RasterLattice& lattice);

    std::size_t triangle_bytes() const override { return sizeof(TriangleRecord); }
    std::size_t most_a_cell() const override { return 2; }
    std::size_t make(std::span<const CellId> cells, std::byte* into,
                     std::vector<CellOffLattice>& off_lattice) const override;

private:
    bool covers_a_centre(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c) const;

    std::span<const std::uint32_t> vertices_;
    std::span<const std::uint8_t> turned_;
    const ScreenPoints& points_;
    glm::ivec2 first_, last_; // the image's pixels, from its centre
    int half_step_;            // a pixel's corner to its centre, in lattice steps
    int shift_;                // a pixel is 2^shift_ lattice steps
};

} // namespace visorder
