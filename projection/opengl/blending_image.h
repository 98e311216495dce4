#pragma once

#include "graphics/framebuffer.h"
#include "projection/opengl/raster_lattice.h"
#include "visorder/image.h"

#include <glm/vec2.hpp>
#include <optional>

namespace visorder::detail {

/// The image that renderers blend translucent parts into, one over the other, farthest first. Its context must be
/// current where it is made and used.
class BlendingImage {
public:
    /// `bits` are those of a channel: 32 or 16 (floats), or 8; InputError for others. With `channels_apart`, each
    /// channel is blended in an image of its own: software renderers do that far quicker than images of four channels,
    /// whose pixels they mask one by one.
    BlendingImage(const Context& context, int bits, bool channels_apart);

    /// Throws InputError for bits that there are not.
    static void check_bits(int bits);

    /// What fragment shaders hand their light on with: put(vec4), red, green and blue premultiplied by opacity. Shaders
    /// for channels apart have CHANNELS_APART defined.
    static const char* shader_text();

    /// Clears an image of this size and has all draws blended into it from now on. The viewport reaches beyond it, as
    /// far around `centre` as the lattice does, so that no triangle is clipped: that would move its corners. Throws
    /// InputError for a size that cannot be drawn.
    void start(glm::ivec2 size, glm::ivec2 centre, const RasterLattice& lattice);

    /// What has been drawn.
    Image read() const;

private:
    const Context* context_;
    std::vector<GLenum> formats_;
    std::optional<Framebuffer> framebuffer_;
};

} // namespace visorder::detail
