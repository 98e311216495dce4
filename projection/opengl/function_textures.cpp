#include "projection/opengl/function_textures.h"

#include "optics/preintegration.h"
#include "visorder/error.h"

#include <fmt/format.h>

namespace visorder::detail {

namespace {

constexpr GLuint pieces_unit = 0;
constexpr GLuint first_piece_unit = 1;
constexpr GLuint table_unit = 2;
// Of the storage buffer that exact_shader_in_doubles reads.
constexpr GLuint pieces_binding = 2;
static_assert(sizeof(OpticalPieces::Piece) == 64, "as the shader declares it");

void fill(const Context& context, GlObject& buffer, GlObject& texture, GLenum format, const void* data,
          std::size_t bytes)
{
    buffer = GlObject(context, GlKind::buffer);
    texture = GlObject(context, GlKind::texture, GL_TEXTURE_BUFFER);
    context.gl().NamedBufferStorage(buffer.id(), static_cast<GLsizeiptr>(bytes), data, 0);
    context.gl().TextureBuffer(texture.id(), format, buffer.id());
}

GlObject table_texture(const Context& context, GLenum target, GLint filter)
{
    GlObject texture(context, GlKind::texture, target);
    const GlFunctions& gl = context.gl();
    gl.TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, filter);
    gl.TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, filter);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        gl.TextureParameteri(texture.id(), axis, GL_CLAMP_TO_EDGE);
    return texture;
}

bool has_table(Integrator integrator)
{
    return integrator == Integrator::preintegrated_2d || integrator == Integrator::preintegrated_3d;
}

} // namespace

FunctionTextures::FunctionTextures(const Context& context, Integrator integrator, const TableOptions& options,
                                   const WayLengths& lengths)
    : context_(&context), integrator_(integrator), options_(options), lengths_(lengths)
{
    constexpr std::size_t scalars_2d = 1024;
    constexpr std::size_t scalars_3d = 256;
    if (options_.scalars == 0)
        options_.scalars = integrator == Integrator::preintegrated_2d ? scalars_2d : scalars_3d;
    if (!has_table(integrator))
        return;
    GLint largest = 0;
    const bool solid = integrator == Integrator::preintegrated_3d;
    context.gl().GetIntegerv(solid ? GL_MAX_3D_TEXTURE_SIZE : GL_MAX_TEXTURE_SIZE, &largest);
    for (const std::size_t side : {options_.scalars, solid ? options_.lengths : options_.scalars})
        if (side < 2 || side > static_cast<std::size_t>(largest))
            throw InputError(fmt::format("a table of {} entries a side cannot be made: 2 to {} on {}", side, largest,
                                         context.renderer()));
}

void FunctionTextures::set(const OpticalPieces& pieces)
{
    const GlFunctions& gl = context_->gl();
    const NarrowedPieces narrow = narrowed(pieces);
    fill(*context_, pieces_buffer_, pieces_, GL_RGBA32F, narrow.pieces.data(),
         narrow.pieces.size() * sizeof(NarrowedPieces::Piece));
    fill(*context_, first_piece_buffer_, first_piece_, GL_R32I, narrow.first_piece.data(),
         narrow.first_piece.size() * sizeof(std::int32_t));
    if (integrator_ == Integrator::exact) {
        pieces_in_doubles_ = GlObject(*context_, GlKind::buffer);
        gl.NamedBufferStorage(pieces_in_doubles_.id(),
                              static_cast<GLsizeiptr>(pieces.pieces.size() * sizeof(OpticalPieces::Piece)),
                              pieces.pieces.data(), 0);
    }
    const auto size = static_cast<GLsizei>(options_.scalars);
    if (integrator_ == Integrator::preintegrated_2d) {
        const std::vector<glm::vec4> table = preintegrated_2d(pieces, options_.scalars, lengths_.mean);
        length_scale_ = 1 / lengths_.mean;
        // The nearest of so many entries is right to far less than being linear in length is, and takes a fifth less
        // time where software draws.
        table_ = table_texture(*context_, GL_TEXTURE_2D, GL_NEAREST);
        gl.TextureStorage2D(table_.id(), 1, GL_RGBA32F, size, size);
        gl.TextureSubImage2D(table_.id(), 0, 0, 0, size, size, GL_RGBA, GL_FLOAT, table.data());
    }
    if (integrator_ == Integrator::preintegrated_3d) {
        const LengthAxis axis = length_axis(options_.lengths, lengths_.longest, options_.exponential_lengths);
        const std::vector<glm::vec4> table = preintegrated_3d(pieces, options_.scalars, axis.lengths);
        const auto depth = static_cast<GLsizei>(options_.lengths);
        length_scale_ = axis.scale;
        table_ = table_texture(*context_, GL_TEXTURE_3D, GL_LINEAR);
        gl.TextureStorage3D(table_.id(), 1, GL_RGBA32F, size, size, depth);
        gl.TextureSubImage3D(table_.id(), 0, 0, 0, 0, size, size, depth, GL_RGBA, GL_FLOAT, table.data());
    }
    context_->check();
}

void FunctionTextures::introduce(Program& program, bool pieces) const
{
    if (pieces) {
        program.set("pieces", static_cast<int>(pieces_unit));
        program.set("first_piece", static_cast<int>(first_piece_unit));
    }
    if (has_table(integrator_)) {
        program.set("table", static_cast<int>(table_unit));
        program.set("length_scale", static_cast<float>(length_scale_));
        if (integrator_ == Integrator::preintegrated_3d)
            program.set("exponential_axis", options_.exponential_lengths ? 1 : 0);
    }
}

void FunctionTextures::bind() const
{
    const GlFunctions& gl = context_->gl();
    gl.BindTextureUnit(pieces_unit, pieces_.id());
    gl.BindTextureUnit(first_piece_unit, first_piece_.id());
    if (pieces_in_doubles_)
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, pieces_binding, pieces_in_doubles_.id());
    if (table_)
        gl.BindTextureUnit(table_unit, table_.id());
}

} // namespace visorder::detail
