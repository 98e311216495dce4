#pragma once

#include <stdexcept>

namespace visorder {

/// OpenGL is not there, is not enough, or reported an error. The message names the renderer where there is one.
class GraphicsError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace visorder
