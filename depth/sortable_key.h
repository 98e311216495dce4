#pragma once

#include <bit>
#include <cstdint>

namespace visorder::detail {

/// Unsigned keys that ascend where the numbers descend: sorted by them, the greatest number comes first.
inline std::uint32_t descending_key(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t ascending = bits ^ ((bits >> 31) != 0 ? 0xffffffffu : 0x80000000u);
    return ~ascending;
}

inline std::uint64_t descending_key(double x)
{
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t ascending = bits ^ ((bits >> 63) != 0 ? ~std::uint64_t{0} : std::uint64_t{1} << 63);
    return ~ascending;
}

} // namespace visorder::detail
