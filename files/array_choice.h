#pragma once

#include "files/file_grid.h"

#include <span>
#include <string_view>

namespace visorder::detail {

/// The array of that name, of points rather than of cells if both have it; for an empty name the one that
/// `ReadOptions::scalar` tells of, the grid's default counting as active if it varies; null if there is none. Throws
/// InputError, which lists the arrays there are, where the named one is missing.
const FileArray* choose_array(const FileGrid& grid, const std::string& name);

/// Whether an array of whole numbers with this name most likely numbers things: GlobalNodeId, ids, block_id, ....
bool is_name_of_ids(std::string_view name);

/// What there is to say of an array.
ArraySummary summary_of(const FileArray& array);

/// The map that loses least of these values in single precision, or the identity where that loses next to nothing. Not
/// finite ones do not count.
ScalarMap scalar_map_of(std::span<const double> values);

} // namespace visorder::detail
