#pragma once

#include "graphics/framebuffer.h"
#include "graphics/program.h"
#include "layering/image_triangles.h"
#include "layering/item_flags.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace visorder::detail {

/// A rectangle of pixels, its lower left corner first.
struct PixelRectangle {
    glm::ivec2 from{0};
    glm::ivec2 size{0};

    std::size_t pixel_count() const { return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y); }
};

/// The item buffer technique (Krishnan, Silva, Wei 2002, section 3): items are drawn so that a pixel's colour names the
/// item that it shows. A pixel holds 0 where there is none, else the item's number plus 1.
///
/// The depth is reversed, 1 at the nearest point and 0 at the farthest, because floating-point numbers are finest near
/// 0: what the paper calls LESS is GREATER here, and GEQUAL is LEQUAL. Items are drawn by ascending number, so that of
/// several at one depth the one with the lower number counts as nearer, in both passes.
///
/// Its context must be current where it is made and used.
class ItemBuffer {
public:
    explicit ItemBuffer(const Context& context);

    /// What is drawn from now on, in images of `size`. Keeps memory of the renderer where it is large enough. Throws
    /// InputError for a size that cannot be drawn.
    void set(const ImageTriangles& triangles, glm::ivec2 size);

    /// Step 2 of the paper: the nearest image. Clears and draws within `within`; `items` ascend.
    void draw_nearest(std::span<const std::uint32_t> items, const PixelRectangle& within);

    /// Steps 4a and 4b: the farthest image, and in the stencil buffer how many items cover each pixel, up to 255.
    void draw_farthest(std::span<const std::uint32_t> items, const PixelRectangle& within);

    /// Appends those of the items that somewhere cover a pixel where the nearest image shows another one, ascending:
    /// what step 4 finds pass by pass, also where more than 255 items lie behind each other. Returns how many words of
    /// flags were read.
    std::size_t find_covered(std::span<const std::uint32_t> items, const PixelRectangle& within,
                             std::vector<std::uint32_t>& covered);

    /// Draws items by a program of the caller's, whose fragment shader follows `fragment_preamble`, and writes to
    /// buffers alone: there is no image and no depth test.
    void draw_with(const Program& program, std::span<const std::uint32_t> items, const PixelRectangle& within);

    /// Of fragment shaders: declares what `covers(sample)`, `depth_at(sample)` and `item` (its number) need. The sample
    /// is gl_FragCoord.xy.
    static const char* fragment_preamble();
    static const char* vertex_shader();

    /// Reads a rectangle of an image into the same place of an array with rows of `row_length`.
    void read_nearest(const PixelRectangle& rectangle, int row_length, std::uint32_t* into) const;
    void read_farthest(const PixelRectangle& rectangle, int row_length, std::uint32_t* into) const;
    void read_stencil(const PixelRectangle& rectangle, int row_length, std::uint8_t* into) const;

    const Context& context() const { return *context_; }
    glm::ivec2 size() const { return framebuffer_ ? framebuffer_->size() : glm::ivec2(0); }
    PixelRectangle whole() const { return {glm::ivec2(0), size()}; }
    std::uint32_t item_count() const { return static_cast<std::uint32_t>(begin_.size() - 1); }
    GLuint nearest_image() const { return framebuffer_->colour(0); }
    GLuint farthest_image() const { return framebuffer_->colour(1); }
    GLuint depth_stencil_image() const { return framebuffer_->depth_stencil(); }

    /// Bytes held by the renderer.
    std::size_t bytes() const;

private:
    void read(std::size_t image, const PixelRectangle& rectangle, int row_length, GLenum format, GLenum type,
              void* into) const;
    void clear(int image, float depth, const PixelRectangle& within);
    void draw(std::span<const std::uint32_t> items);

    const Context* context_;
    std::optional<Framebuffer> framebuffer_;
    GlObject no_image_; // a framebuffer without attachments
    GlObject vertices_;
    GlObject indices_;
    GlObject triangles_;
    ItemFlags covered_;
    std::size_t triangle_bytes_ = 0;
    Program show_;
    Program mark_;
    std::vector<std::uint32_t> begin_{0};
    std::vector<std::uint32_t> index_list_;
};

} // namespace visorder::detail
