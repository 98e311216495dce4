#pragma once

#include "checking/image_errors.h"
#include "graphics/context.h"
#include "optics/medium_integral.h"
#include "projection/opengl/renderer.h"
#include "projection/opengl/surface_renderer.h"
#include "visorder/image.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"
#include "visorder/transfer_function.h"
#include "visorder/view.h"

#include <memory>
#include <string>
#include <vector>

namespace visorder::bench {

using namespace detail;

/// What one integrator makes of a scene, against the reference ray caster.
struct IntegratorResult {
    const char* integrator;
    ImageErrors errors; ///< away from silhouettes
    double seconds;     ///< a frame, of a sorted scene
};

/// A transfer function as the ray caster, which shares no code with the renderer, takes it.
std::vector<MediumPoint> medium_of(const TransferFunction& function);

/// Frames of one scene, drawn in whatever order, to see what an order does to the picture. The medium is the named
/// transfer function "rainbow" over the scene's scalars, in which order shows: all of it is translucent, and near
/// colours differ from far ones. A surface has the same colours, and hides half of what is behind it.
///
/// One thread at a time.
class Frames {
public:
    /// Throws InputError for a scene that cannot be drawn, saying why, and GraphicsError where there is no OpenGL.
    Frames(const Scene& scene, GlPlatform platform);

    const std::string& gl_renderer() const { return context_.renderer(); }

    Image draw(const View& view, const Order& order);

    /// The errors and times of all integrators, in an order that is right; none of a surface, which has no medium.
    std::vector<IntegratorResult> integrators(const View& view, const Order& order);

private:
    Scene scene_;
    Context context_;
    TransferFunction function_;
    std::unique_ptr<ProjectionRenderer> renderer_;      // of a volume,
    std::unique_ptr<SurfaceRenderer> surface_renderer_; // or of a surface
};

} // namespace visorder::bench
