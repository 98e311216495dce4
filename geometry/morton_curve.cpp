#include "geometry/morton_curve.h"

#include <algorithm>

namespace visorder::detail {

namespace {

constexpr double steps = 1024; // along each axis

// Spreads the lowest 10 bits to every third bit.
std::uint32_t spread(std::uint32_t x)
{
    x = (x | x << 16) & 0x030000ffu;
    x = (x | x << 8) & 0x0300f00fu;
    x = (x | x << 4) & 0x030c30c3u;
    x = (x | x << 2) & 0x09249249u;
    return x;
}

} // namespace

// Halves keep the extent of a box as large as doubles allow finite.
MortonCurve::MortonCurve(const Box& box) : half_min_(box.min * 0.5)
{
    for (int axis = 0; axis < 3; ++axis) {
        const double half_extent = box.max[axis] * 0.5 - half_min_[axis];
        scale_[axis] = half_extent > 0 ? steps / half_extent : 0;
    }
}

std::uint32_t MortonCurve::key(const glm::dvec3& point) const
{
    std::uint32_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double x = std::clamp((point[axis] * 0.5 - half_min_[axis]) * scale_[axis], 0.0, steps - 1);
        key |= spread(static_cast<std::uint32_t>(x)) << axis;
    }
    return key;
}

} // namespace visorder::detail
