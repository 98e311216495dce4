#pragma once

#include "visorder/gl_platform.h"
#include "visorder/image.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"
#include "visorder/transfer_function.h"
#include "visorder/view.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace visorder {

/// How a tetrahedron becomes triangles of which every fragment knows where its ray enters and leaves the cell.
enum class Projector {
    silhouette, ///< its outline, one triangle or two; fragments know the thickness as a function of the pixel
    planes,     ///< the same outline; fragments find entry and exit from the planes of the faces
    thick,      ///< three or four triangles around the thickest point (Shirley and Tuchman 1990), with thickness
    thick_gpu   ///< the same triangles, made by the vertex shader
};

/// What the integral of light along a ray through a cell is taken for.
enum class Integrator {
    linear,           ///< colour and opacity interpolated between vertices (Shirley and Tuchman 1990)
    exponential,      ///< opacity of averaged extinction times length, colours of vertices averaged (Stein et al. 1994)
    preintegrated_2d, ///< a table over entry and exit scalar, scaled by length (Roettger et al. 2000, section 4)
    preintegrated_3d, ///< a table over entry and exit scalar and length (Roettger et al. 2000, section 3)
    exact             ///< the integral itself, split at the points of the transfer function
};

const char* name(Projector projector);
const char* name(Integrator integrator);

std::span<const Projector> projectors();
std::span<const Integrator> integrators();

/// By name: silhouette, planes, thick, thick-gpu. Throws InputError for another.
Projector projector_named(std::string_view name);
/// By name: linear, exponential, preintegrated-2d, preintegrated-3d, exact. Throws InputError for another.
Integrator integrator_named(std::string_view name);

/// The tables of the integrators that have any.
struct TableOptions {
    std::size_t scalars = 0;         ///< entries along each scalar; 0: 1024 in two dimensions, 256 in three
    std::size_t lengths = 32;        ///< entries along the length
    bool exponential_lengths = true; ///< finer for short ways; else even (see LengthAxis)
};

/// How a scene is drawn.
struct RenderOptions {
    Projector projector = Projector::silhouette;
    Integrator integrator = Integrator::exact;
    int blending_bits = 32; ///< of a channel of the framebuffer: 32 or 16 (floats), or 8
    /// Whether each channel is blended in an image of its own and, by silhouettes, rows are interpolated: the same
    /// picture, quicker where the processor draws. Chosen by that if it is not set.
    std::optional<bool> for_software;
    TableOptions tables;
};

/// What the last frame took. Preparing and drawing overlap.
struct RenderStatistics {
    double place_s = 0;         ///< points onto the screen
    double prepare_s = 0;       ///< cells into triangles
    double draw_s = 0;          ///< from the first command to the last pixel, what is prepared meanwhile included
    double read_s = 0;          ///< the image back
    std::size_t triangles = 0;  ///< drawn
    std::size_t near_cells = 0; ///< that no triangles stand for: see NearCell
};

/// Draws the cells of a scene one after another, in the sequence of an Order: what differs between two images of one
/// renderer is the order alone. Holds a copy of its Scene. One `draw` at a time.
class Renderer {
public:
    virtual ~Renderer() = default;

    /// Tables are computed anew where the integrator has any. No order changes.
    virtual void set_transfer_function(const TransferFunction& function) = 0;

    /// Throws InputError for an order that does not list as many cells as the scene has, a view that is no projection,
    /// and a size that cannot be drawn.
    virtual Image draw(const View& view, const Order& order) = 0;

    /// Of the last frame.
    virtual const RenderStatistics& statistics() const = 0;

    /// What draws: the name of OpenGL's renderer.
    virtual std::string device() const = 0;
};

/// Draws by OpenGL without a window, on any thread. Throws InputError for cells other than tetrahedra (subdivide the
/// mesh first), for a mesh without scalars or with one that is not finite (naming the point in the caller's numbering),
/// for more than 2^30 points, and for blending bits other than 32, 16 and 8; GraphicsError where there is no OpenGL.
std::unique_ptr<Renderer> make_opengl_renderer(const Scene& scene, const TransferFunction& function,
                                               const RenderOptions& options = {},
                                               GlPlatform platform = GlPlatform::automatic);

} // namespace visorder
