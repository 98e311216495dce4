#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace visorder {

/// A picture in linear colour: red, green and blue premultiplied by alpha, which says how much of what is behind is
/// hidden. Over black, red, green and blue are what is seen.
struct Image {
    glm::ivec2 size{0}; ///< pixels
    std::vector<glm::vec4>
        pixels; ///< size.x * size.y, row by row from the bottom up, each from the left (OpenGL's way)

    std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
    }
};

} // namespace visorder
