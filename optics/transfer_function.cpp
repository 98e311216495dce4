#include "visorder/transfer_function.h"

#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <utility>

namespace visorder {

namespace {

void check(std::span<const OpticalPoint> points)
{
    if (points.empty())
        throw InputError("a transfer function needs a point");
    for (std::size_t i = 0; i < points.size(); ++i) {
        const OpticalPoint& p = points[i];
        if (!std::isfinite(p.scalar))
            throw InputError(fmt::format("point {}: scalar {} is not finite", i, p.scalar));
        if (!std::isfinite(p.extinction) || p.extinction < 0)
            throw InputError(fmt::format("point {}: extinction {} must be finite and at least 0", i, p.extinction));
        for (int k = 0; k < 3; ++k)
            if (!(p.colour[k] >= 0 && p.colour[k] <= 1))
                throw InputError(fmt::format("point {}: colour ({}, {}, {}) must lie in [0, 1]", i, p.colour.x,
                                             p.colour.y, p.colour.z));
        if (i >= 1 && p.scalar < points[i - 1].scalar)
            throw InputError(
                fmt::format("point {}: scalar {} is below {}, the one before", i, p.scalar, points[i - 1].scalar));
        if (i >= 2 && p.scalar == points[i - 2].scalar)
            throw InputError(fmt::format("point {}: the third at scalar {}", i, p.scalar));
    }
    if (!std::isfinite(points.back().scalar - points.front().scalar))
        throw InputError(fmt::format("point {}: scalar {} is too far from {}, the first", points.size() - 1,
                                     points.back().scalar, points.front().scalar));
}

} // namespace

TransferFunction::TransferFunction(std::vector<OpticalPoint> points) : points_(std::move(points))
{
    check(points_);
}

OpticalPoint TransferFunction::at(double scalar) const
{
    const auto above = std::upper_bound(points_.begin(), points_.end(), scalar,
                                        [](double s, const OpticalPoint& point) { return s < point.scalar; });
    const OpticalPoint& b = above == points_.end() ? points_.back() : *above;
    const OpticalPoint& a = above == points_.begin() ? points_.front() : *(above - 1);
    if (&a == &b)
        return {scalar, a.extinction, a.colour};
    const double t = (scalar - a.scalar) / (b.scalar - a.scalar);
    return {scalar, a.extinction + t * (b.extinction - a.extinction), glm::mix(a.colour, b.colour, t)};
}

double extinction_of(double opacity, double length)
{
    return -std::log1p(-opacity) / length;
}

} // namespace visorder
