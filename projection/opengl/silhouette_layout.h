#pragma once

#include "visorder/renderer.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <string>

namespace visorder::detail {

/// How a triangle of SilhouetteTriangles stands in memory: the same for all three corners but for where they are.
///
/// A vertex's attributes begin with its place. Only the first one's others count, and they may reach into the memory
/// of the other two: each vector stands once per triangle, and none is fetched through a storage buffer. (Software
/// renderers gather whatever is not an attribute or an interpolated value lane by lane, uniforms included.)
class SilhouetteLayout {
public:
    /// `passes`: whether triangles come with an OpticalPass.
    SilhouetteLayout(Integrator integrator, bool passes);

    std::size_t triangle_bytes() const { return 3 * static_cast<std::size_t>(a_corner_) * sizeof(glm::vec4); }
    int vertex_attributes() const { return 3 * a_corner_; }
    std::span<const char* const> names() const { return {names_.data(), count_}; }

    /// The vertex shader: hands on `place`, `shape` and what `names` lists, for a triangle as a whole.
    std::string vertex_shader() const;
    /// How the fragment shader declares these.
    std::string declarations() const;

    /// Writes a triangle; corners as the viewport has them, vectors in the sequence of `names`.
    void write(std::byte* into, const std::array<glm::vec2, 3>& corners, const glm::vec2& place, const glm::vec4& shape,
               std::span<const glm::vec4> vectors) const
    {
        const std::array<glm::vec4, 3> heads{glm::vec4(corners[0], place), glm::vec4(corners[1], shape.x, shape.y),
                                             glm::vec4(corners[2], shape.z, shape.w)};
        auto* next = reinterpret_cast<float*>(into);
        std::size_t written = 0;
        const auto rest = static_cast<std::size_t>(a_corner_ - 1);
        for (const glm::vec4& head : heads) {
            std::memcpy(next, &head, sizeof head);
            next += 4;
            const std::size_t some = written + rest > vectors.size() ? vectors.size() - written : rest;
            std::memcpy(next, vectors.data() + written, some * sizeof(glm::vec4));
            next += 4 * rest;
            written += some;
        }
    }

    static constexpr std::size_t most_vectors = 10;

private:
    int location(std::size_t vector) const;

    std::array<const char*, most_vectors> names_{};
    std::size_t count_ = 0;
    bool passes_;
    int a_corner_; // vectors
};

/// Of a vertex shader: `void hand_on_place(vec2)`, to be called once gl_Position is set, gives fragments where the cell
/// is (see PackedPlace), how long rays are there, and, if ROWS is defined, an interpolated row.
std::string place_vertex_shader();

} // namespace visorder::detail
