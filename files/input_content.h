#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace visorder::detail {

/// All bytes of a file, or of a pipe or device until it ends. Throws InputError, which does not name the file: for a
/// folder, for what cannot be opened, for a pipe or device that gives nothing for 20 s or does not end after
/// `most_bytes` or 512 MiB, and for a file longer than `most_bytes`. A pipe that nobody writes to is empty.
std::string input_content(const std::filesystem::path& path, std::uint64_t most_bytes);

} // namespace visorder::detail
