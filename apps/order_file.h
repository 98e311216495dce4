#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace visorder::apps {

// Files that list cells: with the ending .npy a NumPy array of one dimension, else text, a number a line.

/// Writes, to a NumPy array, unsigned numbers of 32 bits, or of 64 where that is too few. Throws InputError, naming the
/// file, where it cannot be written.
void write_order(const std::filesystem::path& file, std::span<const std::uint64_t> cells);

/// Reads what `write_order` writes, and NumPy arrays of any integer type in either byte order. Throws InputError,
/// naming the file and the place, for anything else.
std::vector<std::uint64_t> read_order(const std::filesystem::path& file);

} // namespace visorder::apps
