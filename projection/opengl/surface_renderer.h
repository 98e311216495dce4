#pragma once

#include "graphics/program.h"
#include "parallel/large_array.h"
#include "projection/opengl/blending_image.h"
#include "projection/opengl/raster_lattice.h"
#include "projection/opengl/upload_ring.h"
#include "projection/surface_triangles.h"
#include "visorder/image.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"
#include "visorder/transfer_function.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace visorder::detail {

struct SurfaceOptions {
    double opacity = 0.5;                     ///< of each triangle, in [0, 1]
    glm::dvec3 colour{0.1, 0.3, 0.7};         ///< linear, each channel in [0, 1]
    std::optional<TransferFunction> function; ///< whose colours, by the scalars, are taken instead; not its extinction
    int blending_bits = 32;                   ///< as in RenderOptions
    std::optional<bool> channels_apart;       ///< as BlendingImage has it; chosen by the context if it is not set
};

/// What the last frame took.
struct SurfaceStatistics {
    double place_s = 0;        ///< points onto the screen
    double draw_s = 0;         ///< triangles made and drawn
    double read_s = 0;         ///< the image back
    std::size_t triangles = 0; ///< drawn; the others cover no pixel's centre
};

/// Draws a surface scene, one translucent triangle over the other in the sequence of an Order. A triangle hides the
/// same part of what is behind it from all sides. Scalars are linear in each triangle. A pixel shows the triangles that
/// the ray through its centre passes through, found out in doubles (see SurfaceTriangles): of the triangles around an
/// edge or a corner, one on each side.
///
/// Rays begin at the eye, or, in a parallel view, infinitely far before the scene; near and far plane are ignored.
/// Holds a reference to the context, which must outlive it. One `draw` at a time, on the context's thread.
class SurfaceRenderer {
public:
    /// Throws InputError for cells other than triangles, for options out of range, and, where there is a function, for
    /// a mesh without scalars or with one that is not finite (naming the point in the caller's numbering);
    /// GraphicsError where OpenGL refuses.
    SurfaceRenderer(const Context& context, const Scene& scene, const SurfaceOptions& options = {});
    SurfaceRenderer(const SurfaceRenderer&) = delete;
    SurfaceRenderer& operator=(const SurfaceRenderer&) = delete;

    /// Throws InputError for an order that does not list as many cells as the scene has, a view that is no projection
    /// (see Screen), and a size that cannot be drawn.
    Image draw(const View& view, const Order& order);

    const SurfaceStatistics& statistics() const { return statistics_; }

private:
    void place(const Screen& screen);
    std::size_t make(const SurfaceTriangles& triangles, const Order& order, std::size_t first,
                     const UploadRing::Segment& segment);

    const Context* context_;
    Scene scene_;
    SurfaceOptions options_;
    bool channels_apart_;
    RasterLattice lattice_;
    BlendingImage image_;
    Program program_;
    GlObject no_attributes_;
    GlObject function_; // a buffer of its points
    UploadRing ring_;
    LargeArray<CellId> inner_cells_; // of each of the caller's cells
    LargeArray<SurfacePoint> points_;
    std::vector<SurfaceTriangle> made_;
    std::vector<std::uint8_t> is_seen_;
    SurfaceStatistics statistics_;
};

} // namespace visorder::detail
