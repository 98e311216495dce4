#include "optics/medium_integral.h"

#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace visorder::detail {

namespace {

// The mean of exp(-(a v + b v^2)) over v in [0, 1].
double mean_transmittance(double a, double b)
{
    // Abscissas and weights of Gauss-Legendre quadrature with eight points on [-1, 1] (Abramowitz and Stegun, 25.4).
    constexpr double abscissas[] = {0.183434642495649805, 0.525532409916328986, 0.796666477413626740,
                                    0.960289856497536232};
    constexpr double weights[] = {0.362683783378361983, 0.313706645877887287, 0.222381034453374471,
                                  0.101228536290376259};
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        const double low = 0.5 - 0.5 * abscissas[i];
        const double high = 0.5 + 0.5 * abscissas[i];
        sum += weights[i] * (std::exp(-low * (a + b * low)) + std::exp(-high * (a + b * high)));
    }
    return sum / 2;
}

} // namespace

MediumIntegral::MediumIntegral(std::span<const MediumPoint> points) : points_(points.begin(), points.end())
{
    if (points_.empty())
        throw InputError("a medium needs a point");
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const MediumPoint& p = points_[i];
        if (!std::isfinite(p.scalar) || !std::isfinite(p.extinction) || !std::isfinite(p.colour.x) ||
            !std::isfinite(p.colour.y) || !std::isfinite(p.colour.z))
            throw InputError(fmt::format("point {} of the medium: a number is not finite", i));
        if (p.extinction < 0)
            throw InputError(fmt::format("point {} of the medium: extinction {} is negative", i, p.extinction));
        if ((i >= 1 && p.scalar < points_[i - 1].scalar) || (i >= 2 && p.scalar == points_[i - 2].scalar))
            throw InputError(fmt::format("point {} of the medium: scalar {} does not ascend", i, p.scalar));
    }
}

// In the stretch below points_[above] and above the point before it.
MediumIntegral::Properties MediumIntegral::between(std::size_t above, double scalar) const
{
    if (above == 0)
        return {points_.front().extinction, points_.front().colour};
    if (above == points_.size())
        return {points_.back().extinction, points_.back().colour};
    const MediumPoint& a = points_[above - 1];
    const MediumPoint& b = points_[above];
    const double of_b = (scalar - a.scalar) / (b.scalar - a.scalar);
    const double of_a = (b.scalar - scalar) / (b.scalar - a.scalar);
    return {of_a * a.extinction + of_b * b.extinction, of_a * a.colour + of_b * b.colour};
}

void MediumIntegral::pass(Light& light, double length, double first, double last) const
{
    const auto below = [](double scalar, const MediumPoint& p) { return scalar < p.scalar; };
    if (first == last) {
        const std::size_t above = std::upper_bound(points_.begin(), points_.end(), first, below) - points_.begin();
        const Properties same = between(above, first);
        return pass_linear(light, length, same, same);
    }
    // Ascending scalars leave a stretch at the point above it, descending ones at the point below.
    const bool ascends = first < last;
    std::size_t above = ascends ? std::upper_bound(points_.begin(), points_.end(), first, below) - points_.begin()
                                : std::lower_bound(points_.begin(), points_.end(), first,
                                                   [](const MediumPoint& p, double s) { return p.scalar < s; }) -
                                      points_.begin();
    double here = first;
    while (here != last && light.transmittance > opaque) {
        double there = last;
        if (ascends && above < points_.size())
            there = std::min(last, points_[above].scalar);
        else if (!ascends && above > 0)
            there = std::max(last, points_[above - 1].scalar);
        if (there != here)
            pass_linear(light, length * ((there - here) / (last - first)), between(above, here), between(above, there));
        here = there;
        above = ascends ? above + 1 : above - 1;
    }
}

void MediumIntegral::pass_linear(Light& light, double length, const Properties& first, const Properties& last)
{
    const glm::dvec3 colour_change = last.colour - first.colour;
    const double bend = (last.extinction - first.extinction) * length / 2;
    double position = 0; // from 0 to 1
    while (position < 1 && light.transmittance > opaque) {
        const double depth_rate = first.extinction * length + 2 * bend * position;
        double step = 1 - position;
        if (step * (depth_rate + bend * step) > 0.5)
            step = std::min(step, 1 / (depth_rate + std::sqrt(std::max(0.0, depth_rate * depth_rate + 2 * bend))));
        const glm::dvec3 colour = first.colour + position * colour_change;
        if (!(position + step > position)) { // so dense that all else is hidden at once
            light.colour += light.transmittance * colour;
            light.transmittance = 0;
            return;
        }
        const double a = depth_rate * step;
        const double b = bend * step * step;
        const double end = std::exp(-(a + b));
        light.colour += light.transmittance * (colour * -std::expm1(-(a + b)));
        if (colour_change != glm::dvec3(0))
            light.colour += light.transmittance * (step * colour_change * (mean_transmittance(a, b) - end));
        light.transmittance *= end;
        position += step;
    }
}

} // namespace visorder::detail
