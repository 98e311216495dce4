#pragma once

#include "graphics/gl_object.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

namespace visorder::detail {

/// The source of one shader of a program.
struct ShaderSource {
    GLenum stage; ///< GL_VERTEX_SHADER, GL_FRAGMENT_SHADER, GL_GEOMETRY_SHADER or GL_COMPUTE_SHADER
    std::string_view text;
};

/// A linked program. Its context must be current where it is made, set and used.
class Program {
public:
    /// Throws GraphicsError with the compiler's or the linker's words, under `title`.
    Program(const Context& context, std::string_view title, std::initializer_list<ShaderSource> shaders);

    void use() const;

    /// Sets a uniform. One that the program does not use is an error (GraphicsError): it was misspelt.
    void set(const char* uniform, int value);
    void set(const char* uniform, unsigned value);
    void set(const char* uniform, float value);
    void set(const char* uniform, glm::ivec2 value);
    void set(const char* uniform, glm::vec2 value);
    void set(const char* uniform, glm::vec3 value);
    void set(const char* uniform, glm::vec4 value);
    void set(const char* uniform, const glm::mat4& value);
    void set(const char* uniform, double value);
    /// An array, by its name without an index, from its first element on.
    void set(const char* uniform, std::span<const glm::dvec2> values);
    void set(const char* uniform, std::span<const glm::dvec3> values);

    GLuint id() const { return program_.id(); }

private:
    GLint location(const char* uniform);

    const Context* context_;
    std::string title_;
    GlObject program_;
    std::unordered_map<std::string, GLint> locations_;
};

} // namespace visorder::detail
