#pragma once

#include <string>
#include <string_view>

namespace visorder::detail {

/// Text from a file as it can stand in a message: one line of at most 200 characters, with '?' for what is no printable
/// ASCII character.
std::string printable(std::string_view text);

} // namespace visorder::detail
