#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace visorder::detail {

/// The bytes of a regular file. Throws InputError, naming it, where it cannot be read.
std::string content_of_file(const std::filesystem::path& path);

/// What gzip made these bytes of: one member or several. At most 256 MiB
/// and 50 times as much as the bytes given. Throws InputError, naming the file.
std::string decompressed(const std::filesystem::path& path, std::string_view gzip);

} // namespace visorder::detail
