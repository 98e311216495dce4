#pragma once

#include "visorder/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace visorder::detail {

/// How many faces a set of a cell's faces holds, one bit per face. A table, because plain x86-64 has no instruction to
/// count bits.
inline constexpr auto bits_set = [] {
    std::array<std::uint8_t, 1 << max_cell_faces> table{};
    for (std::size_t bits = 1; bits < table.size(); ++bits)
        table[bits] = static_cast<std::uint8_t>(table[bits / 2] + bits % 2);
    return table;
}();

} // namespace visorder::detail
