#pragma once

#include "graphics/program.h"
#include "optics/optical_pieces.h"
#include "parallel/large_array.h"
#include "projection/cell_triangles.h"
#include "projection/opengl/blending_image.h"
#include "projection/opengl/function_textures.h"
#include "projection/opengl/upload_ring.h"
#include "projection/scaled_scalars.h"
#include "projection/screen.h"
#include "projection/screen_points.h"
#include "visorder/image.h"
#include "visorder/renderer.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"
#include "visorder/transfer_function.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace visorder::detail {

/// Draws a scene of tetrahedra by projecting one cell after another, in the sequence of an Order: what differs between
/// two images of one renderer is the order alone.
///
/// Rays begin at the eye, or, in a parallel view, infinitely far before the scene; near and far plane are ignored. The
/// scalar is linear in each cell. Positions are computed once per point, in doubles, and each fragment finds out from
/// them where its ray enters and leaves its cell: no cell is missed and none is hit twice. Memory beyond the scene is
/// about 33 bytes per point and 5 per cell; triangles go to the renderer in stretches of some ten thousand.
///
/// Holds a reference to the context, which must outlive it. One `draw` at a time, on the context's thread.
class ProjectionRenderer {
public:
    /// Throws InputError for cells other than tetrahedra, for a mesh without scalars or with one that is not finite
    /// (naming the point in the caller's numbering), for more than 2^30 points, and for blending bits other than 32,
    /// 16 and 8; GraphicsError where OpenGL refuses.
    ProjectionRenderer(const Context& context, const Scene& scene, const TransferFunction& function,
                       const RenderOptions& options = {});
    ~ProjectionRenderer();
    ProjectionRenderer(const ProjectionRenderer&) = delete;
    ProjectionRenderer& operator=(const ProjectionRenderer&) = delete;

    /// Tables are computed anew where the integrator has any. No order changes.
    void set_transfer_function(const TransferFunction& function);

    /// Throws InputError for an order that does not list as many cells as the scene has, a view that is no projection
    /// (see Screen), and a size that cannot be drawn.
    Image draw(const View& view, const Order& order);

    const RenderStatistics& statistics() const { return statistics_; }

private:
    struct Stretch;

    Program& triangle_program(const Screen& screen);
    void prepare(const Order& order, std::size_t first, const CellTriangles& triangles, Stretch& stretch) const;
    void issue(const Stretch& stretch, const Screen& screen, const CellTriangles& triangles, const Program& program);
    static std::size_t records_a_block(const CellTriangles& triangles);
    void bind(const UploadRing& ring, const UploadRing::Segment& segment, const CellTriangles& triangles) const;
    // Some of a block's: the first one's place in what is bound, and its number in the block.
    struct Records {
        std::size_t place, number, count;
    };
    void draw_records(const Records& records, std::span<const CellApart>& apart, const Screen& screen,
                      const CellTriangles& triangles, const Program& program);
    void add_near_cell(const Screen& screen, CellId cell);
    void draw_near_cells();
    void set_up(const Screen& screen, Program& triangle_program);
    void set_up_triangles(Program& program, const Screen& screen) const;
    void set_up_attributes(const CellTriangles& triangles);

    const Context* context_;
    Scene scene_;
    RenderOptions options_;
    bool software_;
    RasterLattice lattice_;
    BlendingImage image_;
    ScaledScalars scalars_;
    std::vector<std::uint8_t> turned_;                        // of each cell
    std::vector<glm::vec4> optics_;                           // of each point, where the integrator interpolates them
    LargeArray<CellId> inner_cells_;                          // of each of the caller's cells
    std::array<std::optional<Program>, 2> triangle_programs_; // for parallel and for perspective views, once needed
    Program near_cell_program_;
    OpticalPieces pieces_;
    FunctionTextures function_;
    GlObject no_attributes_;
    GlObject attributes_;
    int attribute_count_ = 0;
    UploadRing ring_;
    UploadRing rest_ring_;
    // Near cells that stand one after another in the order are drawn at once.
    UploadRing near_ring_;
    std::optional<UploadRing::Segment> near_segment_;
    std::size_t near_drawn_ = 0;   // records of the segment that have been drawn
    std::size_t near_pending_ = 0; // and those behind them that have not
    ScreenPoints points_;
    std::vector<std::unique_ptr<Stretch>> stretches_;
    RenderStatistics statistics_;
};

} // namespace visorder::detail
