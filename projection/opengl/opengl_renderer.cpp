#include "graphics/context.h"
#include "projection/opengl/renderer.h"
#include "visorder/renderer.h"

namespace visorder {

using namespace detail;

namespace {

// A ProjectionRenderer with a context of its own.
class OpenGlRenderer final : public Renderer {
public:
    OpenGlRenderer(const Scene& scene, const TransferFunction& function, const RenderOptions& options,
                   GlPlatform platform)
        : context_(platform), renderer_(context_, scene, function, options)
    {
    }

    void set_transfer_function(const TransferFunction& function) override { renderer_.set_transfer_function(function); }
    Image draw(const View& view, const Order& order) override { return renderer_.draw(view, order); }
    const RenderStatistics& statistics() const override { return renderer_.statistics(); }
    std::string device() const override { return context_.renderer(); }

private:
    Context context_;
    ProjectionRenderer renderer_;
};

} // namespace

std::unique_ptr<Renderer> make_opengl_renderer(const Scene& scene, const TransferFunction& function,
                                               const RenderOptions& options, GlPlatform platform)
{
    return std::make_unique<OpenGlRenderer>(scene, function, options, platform);
}

} // namespace visorder
