#pragma once

#include <filesystem>
#include <string_view>

namespace visorder::apps {

/// Writes a whole file, or leaves what was there: the text goes to a file beside it, which then takes its place. Throws
/// InputError, naming the file, where it cannot be written.
void write_file(const std::filesystem::path& file, std::string_view text);

} // namespace visorder::apps
