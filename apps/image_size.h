#pragma once

#include <glm/vec2.hpp>
#include <string>

namespace visorder::apps {

/// The size WxH in pixels, such as 512x512. Throws InputError, naming the option, for anything else.
glm::ivec2 image_size(const std::string& text, const char* option);

} // namespace visorder::apps
