#pragma once

#include "scene/cell_shape.h"

#include <filesystem>
#include <span>
#include <vector>

namespace visorder::apps {

// Files that list cells: with the ending .npy a NumPy array of one dimension, else text, a number a line.

/// Writes unsigned 32-bit numbers. Throws InputError, naming the file, where it cannot be written.
void write_order(const std::filesystem::path& file, std::span<const CellId> cells);

/// Reads what `write_order` writes, and NumPy arrays of any integer type in either byte order. Throws InputError,
/// naming the file and the place, for anything else.
std::vector<CellId> read_order(const std::filesystem::path& file);

} // namespace visorder::apps
