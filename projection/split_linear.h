#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>

namespace visorder::detail {

/// A linear function of whole pixels (x, y), up to `reach` from an origin, as shaders evaluate it where single
/// precision is not enough: slope and offset in two parts each, of which the first are multiples of a power of two so
/// coarse that
///
///     high.x * x + high.y * y + high_offset
///
/// is exact, whatever cancels; what low.x * x + low.y * y + low_offset adds is 2^-23 of the terms or less, and rounded.
struct SplitLinear {
    glm::vec2 high, low;
    float high_offset, low_offset;
};

inline SplitLinear split_linear(const glm::dvec2& slope, double offset, double reach)
{
    // With terms that add up to 2^23 units, each sum of some has 24 bits.
    const double terms = 2 * reach * std::max(std::abs(slope.x), std::abs(slope.y)) + std::abs(offset);
    constexpr std::uint64_t exponent_bits = std::uint64_t{0x7ff} << 52;
    const double above = 2 * std::bit_cast<double>(std::bit_cast<std::uint64_t>(terms) & exponent_bits);
    // Adding it rounds to multiples of above 2^-23: it is so large that doubles stand that far apart there.
    const double rounder = above * 0x1.8p29;
    const auto high = [&](double x) { return (x + rounder) - rounder; };
    const glm::dvec2 high_slope(high(slope.x), high(slope.y));
    const double high_offset = high(offset);
    return {glm::vec2(high_slope), glm::vec2(slope - high_slope), static_cast<float>(high_offset),
            static_cast<float>(offset - high_offset)};
}

} // namespace visorder::detail
