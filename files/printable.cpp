#include "files/printable.h"

#include <algorithm>

namespace visorder::detail {

std::string printable(std::string_view text)
{
    constexpr std::size_t longest = 200;
    std::string line(text.substr(0, longest));
    std::replace_if(
        line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return text.size() > longest ? line + "..." : line;
}

} // namespace visorder::detail
