#include "apps/image_size.h"

#include "visorder/error.h"

#include <charconv>
#include <fmt/format.h>

namespace visorder::apps {

glm::ivec2 image_size(const std::string& text, const char* option)
{
    glm::ivec2 size(0);
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.x);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.y);
        if (height.ec == std::errc() && height.ptr == end && size.x > 0 && size.y > 0)
            return size;
    }
    throw InputError(fmt::format("{} takes WxH in pixels, such as 512x512, not \"{}\"", option, text));
}

} // namespace visorder::apps
