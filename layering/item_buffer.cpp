#include "layering/item_buffer.h"

#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string>

namespace visorder::detail {

namespace {

// Three vertices a triangle; all that is known of the triangle goes with them.
constexpr const char* vertex_text = R"(#version 450 core
struct Triangle {
    vec4 corners[3];
    double edges[9];
    double depth[3];
    ivec2 origin;
    uint item;
    uint unused;
};
layout(std430, binding = 0) readonly buffer Triangles { Triangle triangles[]; };
flat out dvec3 edge_0;
flat out dvec3 edge_1;
flat out dvec3 edge_2;
flat out dvec3 depth;
flat out vec2 origin;
flat out uint item;
void main()
{
    int t = gl_VertexID / 3;
    gl_Position = triangles[t].corners[gl_VertexID % 3];
    edge_0 = dvec3(triangles[t].edges[0], triangles[t].edges[1], triangles[t].edges[2]);
    edge_1 = dvec3(triangles[t].edges[3], triangles[t].edges[4], triangles[t].edges[5]);
    edge_2 = dvec3(triangles[t].edges[6], triangles[t].edges[7], triangles[t].edges[8]);
    depth = dvec3(triangles[t].depth[0], triangles[t].depth[1], triangles[t].depth[2]);
    origin = vec2(triangles[t].origin);
    item = triangles[t].item;
}
)";

// The least depth keeps the farthest point apart from what is cleared to.
constexpr const char* preamble_text = R"(#version 450 core
flat in dvec3 edge_0;
flat in dvec3 edge_1;
flat in dvec3 edge_2;
flat in dvec3 depth;
flat in vec2 origin;
flat in uint item;
double at(dvec3 form, dvec2 p) { return form.x * p.x + form.y * p.y + form.z; }
bool covers(vec2 coordinates)
{
    dvec2 p = dvec2(coordinates - origin);
    return at(edge_0, p) > 0.0lf && at(edge_1, p) > 0.0lf && at(edge_2, p) > 0.0lf;
}
float depth_at(vec2 coordinates) { return clamp(float(at(depth, dvec2(coordinates - origin))), 1e-30, 1.0); }
)";

constexpr const char* show_text = R"(
layout(location = 0) out uint shown;
void main()
{
    if (!covers(gl_FragCoord.xy))
        discard;
    shown = item + 1u;
    gl_FragDepth = depth_at(gl_FragCoord.xy);
}
)";

constexpr const char* mark_text = R"(
layout(binding = 0) uniform usampler2D nearest;
layout(std430, binding = 1) coherent buffer Marks { uint marks[]; };
void main()
{
    if (covers(gl_FragCoord.xy) && texelFetch(nearest, ivec2(gl_FragCoord.xy), 0).r != item + 1u)
        atomicOr(marks[item / 32u], 1u << (item % 32u));
}
)";

Program item_program(const Context& context, const char* title, const char* fragment_text)
{
    const std::string fragment = std::string(preamble_text) + fragment_text;
    return Program(context, title, {{GL_VERTEX_SHADER, vertex_text}, {GL_FRAGMENT_SHADER, fragment}});
}

constexpr std::array images{static_cast<GLenum>(GL_R32UI), static_cast<GLenum>(GL_R32UI)};

} // namespace

ItemBuffer::ItemBuffer(const Context& context)
    : context_(&context),
      no_image_(context, GlKind::framebuffer),
      vertices_(context, GlKind::vertex_array),
      indices_(context, GlKind::buffer),
      triangles_(context, GlKind::buffer),
      covered_(context),
      show_(item_program(context, "items", show_text)),
      mark_(item_program(context, "covered items", mark_text))
{
    context.gl().VertexArrayElementBuffer(vertices_.id(), indices_.id());
    context.check();
}

const char* ItemBuffer::fragment_preamble()
{
    return preamble_text;
}

const char* ItemBuffer::vertex_shader()
{
    return vertex_text;
}

void ItemBuffer::set(const ImageTriangles& triangles, glm::ivec2 size)
{
    const GlFunctions& gl = context_->gl();
    if (!framebuffer_ || framebuffer_->size() != size) {
        framebuffer_.reset();
        framebuffer_.emplace(*context_, size, images, GL_DEPTH32F_STENCIL8);
        // Integers cannot be read by a shader with any other filter; of the third image, it reads the stencil values.
        for (const GLuint image : {nearest_image(), farthest_image(), depth_stencil_image()}) {
            gl.TextureParameteri(image, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            gl.TextureParameteri(image, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        }
        gl.TextureParameteri(depth_stencil_image(), GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
        gl.NamedFramebufferParameteri(no_image_.id(), GL_FRAMEBUFFER_DEFAULT_WIDTH, size.x);
        gl.NamedFramebufferParameteri(no_image_.id(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, size.y);
    }
    begin_ = triangles.begin;
    const std::size_t needed = std::max<std::size_t>(1, triangles.triangles.size()) * sizeof(ImageTriangle);
    GLint64 most = 0;
    gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    if (static_cast<GLint64>(needed) > most)
        throw InputError(fmt::format("{} triangles are too many for {}, which can hold {}", triangles.triangles.size(),
                                     context_->renderer(), static_cast<std::size_t>(most) / sizeof(ImageTriangle)));
    if (needed > triangle_bytes_) {
        gl.NamedBufferData(triangles_.id(), static_cast<GLsizeiptr>(needed), nullptr, GL_DYNAMIC_DRAW);
        triangle_bytes_ = needed;
    }
    gl.NamedBufferSubData(triangles_.id(), 0,
                          static_cast<GLsizeiptr>(triangles.triangles.size() * sizeof(ImageTriangle)),
                          triangles.triangles.data());
    context_->check();
}

void ItemBuffer::clear(int image, float depth, const PixelRectangle& within)
{
    const GlFunctions& gl = context_->gl();
    framebuffer_->bind();
    gl.NamedFramebufferDrawBuffer(framebuffer_->id(), GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(image));
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(within.from.x, within.from.y, within.size.x, within.size.y);
    gl.DepthMask(GL_TRUE);
    gl.StencilMask(0xff);
    constexpr std::array<GLuint, 4> none{};
    gl.ClearBufferuiv(GL_COLOR, 0, none.data());
    gl.ClearBufferfi(GL_DEPTH_STENCIL, 0, depth, 0);
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl.DepthRange(0, 1);
    gl.Enable(GL_DEPTH_TEST);
}

void ItemBuffer::draw(std::span<const std::uint32_t> items)
{
    index_list_.clear();
    for (std::uint32_t item : items)
        for (std::uint32_t v = 3 * begin_[item]; v < 3 * begin_[item + 1]; ++v)
            index_list_.push_back(v);
    if (index_list_.empty())
        return;
    const GlFunctions& gl = context_->gl();
    gl.NamedBufferData(indices_.id(), static_cast<GLsizeiptr>(index_list_.size() * sizeof(index_list_[0])),
                       index_list_.data(), GL_STREAM_DRAW);
    gl.BindVertexArray(vertices_.id());
    gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, triangles_.id());
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(index_list_.size()), GL_UNSIGNED_INT, nullptr);
}

void ItemBuffer::draw_nearest(std::span<const std::uint32_t> items, const PixelRectangle& within)
{
    const GlFunctions& gl = context_->gl();
    clear(0, 0, within);
    gl.Disable(GL_STENCIL_TEST);
    gl.DepthFunc(GL_GREATER);
    show_.use();
    draw(items);
}

void ItemBuffer::draw_farthest(std::span<const std::uint32_t> items, const PixelRectangle& within)
{
    const GlFunctions& gl = context_->gl();
    clear(1, 1, within);
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFunc(GL_ALWAYS, 0, 0xff);
    gl.StencilOp(GL_KEEP, GL_INCR, GL_INCR);
    gl.DepthFunc(GL_LEQUAL);
    show_.use();
    draw(items);
}

void ItemBuffer::draw_with(const Program& program, std::span<const std::uint32_t> items, const PixelRectangle& within)
{
    const GlFunctions& gl = context_->gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, no_image_.id());
    gl.Viewport(0, 0, size().x, size().y);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(within.from.x, within.from.y, within.size.x, within.size.y);
    gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_STENCIL_TEST);
    program.use();
    draw(items);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

std::size_t ItemBuffer::find_covered(std::span<const std::uint32_t> items, const PixelRectangle& within,
                                     std::vector<std::uint32_t>& covered)
{
    covered_.reset(item_count(), {});
    context_->gl().BindTextureUnit(0, nearest_image());
    context_->gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, covered_.id());
    draw_with(mark_, items, within);
    std::vector<std::uint32_t> no_words;
    return covered_.read(no_words, covered);
}

void ItemBuffer::read(std::size_t image, const PixelRectangle& rectangle, int row_length, GLenum format, GLenum type,
                      void* into) const
{
    const GlFunctions& gl = context_->gl();
    gl.PixelStorei(GL_PACK_ROW_LENGTH, row_length);
    gl.PixelStorei(GL_PACK_SKIP_PIXELS, rectangle.from.x);
    gl.PixelStorei(GL_PACK_SKIP_ROWS, rectangle.from.y);
    framebuffer_->read(image, rectangle.from, rectangle.size, format, type, into);
    for (const GLenum setting : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS})
        gl.PixelStorei(setting, 0);
}

void ItemBuffer::read_nearest(const PixelRectangle& rectangle, int row_length, std::uint32_t* into) const
{
    read(0, rectangle, row_length, GL_RED_INTEGER, GL_UNSIGNED_INT, into);
}

void ItemBuffer::read_farthest(const PixelRectangle& rectangle, int row_length, std::uint32_t* into) const
{
    read(1, rectangle, row_length, GL_RED_INTEGER, GL_UNSIGNED_INT, into);
}

void ItemBuffer::read_stencil(const PixelRectangle& rectangle, int row_length, std::uint8_t* into) const
{
    read(0, rectangle, row_length, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, into);
}

std::size_t ItemBuffer::bytes() const
{
    // Two items, a depth and a stencil value a pixel.
    const std::size_t of_images = whole().pixel_count() * (4 + 4 + 8);
    return triangle_bytes_ + of_images + begin_.capacity() * sizeof(begin_[0]) +
           2 * index_list_.capacity() * sizeof(index_list_[0]);
}

} // namespace visorder::detail
