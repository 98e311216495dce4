#include "graphics/program.h"

#include <fmt/format.h>
#include <vector>

namespace visorder::detail {

namespace {

GlObject compiled(const Context& context, std::string_view title, const ShaderSource& source)
{
    const GlFunctions& gl = context.gl();
    GlObject shader(context, GlKind::shader, source.stage);
    const GLchar* text = source.text.data();
    const auto length = static_cast<GLint>(source.text.size());
    gl.ShaderSource(shader.id(), 1, &text, &length);
    gl.CompileShader(shader.id());
    GLint compiles = GL_FALSE;
    gl.GetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiles);
    if (compiles != GL_TRUE) {
        std::string log(4096, '\0');
        GLsizei written = 0;
        gl.GetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), &written, log.data());
        log.resize(static_cast<std::size_t>(written));
        throw GraphicsError(fmt::format("{} ({}): shader does not compile: {}", title, context.renderer(), log));
    }
    return shader;
}

} // namespace

Program::Program(const Context& context, std::string_view title, std::initializer_list<ShaderSource> shaders)
    : context_(&context), title_(title), program_(context, GlKind::program)
{
    const GlFunctions& gl = context.gl();
    std::vector<GlObject> parts;
    for (const ShaderSource& source : shaders) {
        parts.push_back(compiled(context, title, source));
        gl.AttachShader(program_.id(), parts.back().id());
    }
    gl.LinkProgram(program_.id());
    GLint links = GL_FALSE;
    gl.GetProgramiv(program_.id(), GL_LINK_STATUS, &links);
    if (links != GL_TRUE) {
        std::string log(4096, '\0');
        GLsizei written = 0;
        gl.GetProgramInfoLog(program_.id(), static_cast<GLsizei>(log.size()), &written, log.data());
        log.resize(static_cast<std::size_t>(written));
        throw GraphicsError(fmt::format("{} ({}): program does not link: {}", title, context.renderer(), log));
    }
}

void Program::use() const
{
    context_->gl().UseProgram(program_.id());
}

GLint Program::location(const char* uniform)
{
    if (const auto known = locations_.find(uniform); known != locations_.end())
        return known->second;
    const GLint location = context_->gl().GetUniformLocation(program_.id(), uniform);
    if (location < 0)
        throw GraphicsError(fmt::format("{}: no uniform \"{}\" in the program", title_, uniform));
    locations_.emplace(uniform, location);
    return location;
}

void Program::set(const char* uniform, int value)
{
    context_->gl().ProgramUniform1i(program_.id(), location(uniform), value);
}

void Program::set(const char* uniform, unsigned value)
{
    context_->gl().ProgramUniform1ui(program_.id(), location(uniform), value);
}

void Program::set(const char* uniform, float value)
{
    context_->gl().ProgramUniform1f(program_.id(), location(uniform), value);
}

void Program::set(const char* uniform, glm::ivec2 value)
{
    context_->gl().ProgramUniform2iv(program_.id(), location(uniform), 1, &value[0]);
}

void Program::set(const char* uniform, glm::vec2 value)
{
    context_->gl().ProgramUniform2fv(program_.id(), location(uniform), 1, &value[0]);
}

void Program::set(const char* uniform, glm::vec3 value)
{
    context_->gl().ProgramUniform3fv(program_.id(), location(uniform), 1, &value[0]);
}

void Program::set(const char* uniform, glm::vec4 value)
{
    context_->gl().ProgramUniform4fv(program_.id(), location(uniform), 1, &value[0]);
}

void Program::set(const char* uniform, const glm::mat4& value)
{
    context_->gl().ProgramUniformMatrix4fv(program_.id(), location(uniform), 1, GL_FALSE, &value[0][0]);
}

void Program::set(const char* uniform, double value)
{
    context_->gl().ProgramUniform1d(program_.id(), location(uniform), value);
}

void Program::set(const char* uniform, std::span<const glm::dvec2> values)
{
    context_->gl().ProgramUniform2dv(program_.id(), location(uniform), static_cast<GLsizei>(values.size()),
                                     &values.data()->x);
}

void Program::set(const char* uniform, std::span<const glm::dvec3> values)
{
    context_->gl().ProgramUniform3dv(program_.id(), location(uniform), static_cast<GLsizei>(values.size()),
                                     &values.data()->x);
}

} // namespace visorder::detail
