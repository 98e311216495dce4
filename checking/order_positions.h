#pragma once

#include "parallel/large_array.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"

#include <cstdint>

namespace visorder::detail {

/// Of every cell of a scene, in the inner numbering, its place in an order, farthest first. Throws InputError, naming a
/// cell, for an order that does not list every cell exactly once.
LargeArray<std::uint32_t> order_positions(const Scene& scene, const Order& order);

} // namespace visorder::detail
