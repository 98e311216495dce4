#include "optics/srgb.h"
#include "scene/scalar_interval.h"
#include "visorder/error.h"
#include "visorder/scene.h"
#include "visorder/transfer_function.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace visorder {

using namespace detail;

namespace {

/// A point of a named function: `position` runs from 0 at the lowest scalar to 1 at the highest, opacity is that of a
/// unit length.
struct NamedPoint {
    double position;
    double opacity;
    glm::dvec3 colour;
};
using NamedPoints = std::vector<NamedPoint>;

/// A published colour map, evenly spaced, under an opacity that rises from 0.
NamedPoints rising(std::span<const std::array<int, 3>> srgb_bytes)
{
    NamedPoints points;
    for (std::size_t i = 0; i < srgb_bytes.size(); ++i) {
        const auto [red, green, blue] = srgb_bytes[i];
        const double position = static_cast<double>(i) / static_cast<double>(srgb_bytes.size() - 1);
        points.push_back({position, 0.6 * position, linear_of_srgb(glm::dvec3(red, green, blue) / 255.0)});
    }
    return points;
}

NamedPoints cool_warm()
{
    constexpr std::array<std::array<int, 3>, 9> map = {{{59, 76, 192},
                                                        {98, 130, 234},
                                                        {141, 176, 254},
                                                        {184, 208, 249},
                                                        {221, 221, 221},
                                                        {245, 196, 173},
                                                        {244, 154, 123},
                                                        {222, 96, 77},
                                                        {180, 4, 38}}};
    return rising(map);
}

NamedPoints viridis()
{
    constexpr std::array<std::array<int, 3>, 9> map = {{{68, 1, 84},
                                                        {71, 43, 122},
                                                        {59, 81, 138},
                                                        {44, 113, 142},
                                                        {32, 143, 140},
                                                        {39, 173, 128},
                                                        {91, 200, 98},
                                                        {170, 219, 50},
                                                        {253, 231, 36}}};
    return rising(map);
}

NamedPoints rainbow()
{
    return {{0, 0.3, {0, 0, 1}},
            {0.25, 0.3, {0, 1, 1}},
            {0.5, 0.3, {0, 1, 0}},
            {0.75, 0.3, {1, 1, 0}},
            {1, 0.3, {1, 0, 0}}};
}

NamedPoints narrow_peak()
{
    constexpr glm::dvec3 ramp{0.1, 0.3, 0.8};
    constexpr glm::dvec3 peak{1, 0.7, 0.1};
    return {{0, 0.01, ramp}, {0.49, 0.055, ramp}, {0.5, 0.98, peak}, {0.51, 0.055, ramp}, {1, 0.1, ramp}};
}

NamedPoints peak_in_haze()
{
    constexpr glm::dvec3 haze{0.1, 0.3, 0.8};
    constexpr glm::dvec3 peak{1, 0.7, 0.1};
    return {{0, 0.5, haze}, {0.495, 0.5, haze}, {0.5, 0.8, peak}, {0.505, 0.5, haze}, {1, 0.5, haze}};
}

NamedPoints steps()
{
    constexpr glm::dvec3 violet{0.3, 0.1, 0.6}, blue{0.1, 0.4, 0.9}, green{0.2, 0.7, 0.3}, amber{0.9, 0.7, 0.1},
        red{0.9, 0.2, 0.1};
    return {{0, 0.05, violet},  {0.2, 0.05, violet}, {0.2, 0.6, blue},  {0.4, 0.6, blue}, {0.4, 0.02, green},
            {0.6, 0.02, green}, {0.6, 0.4, amber},   {0.8, 0.4, amber}, {0.8, 0.9, red},  {1, 0.9, red}};
}

NamedPoints constant()
{
    return {{0, 0.3, {0.8, 0.6, 0.3}}};
}

struct Named {
    const char* name;
    NamedPoints (*points)();
};

constexpr std::array all = {Named{"cool-warm", cool_warm},       Named{"viridis", viridis},
                            Named{"rainbow", rainbow},           Named{"narrow-peak", narrow_peak},
                            Named{"peak-in-haze", peak_in_haze}, Named{"steps", steps},
                            Named{"constant", constant}};

constexpr auto names = [] {
    std::array<const char*, all.size()> result{};
    for (std::size_t i = 0; i < all.size(); ++i)
        result[i] = all[i].name;
    return result;
}();

NamedPoints points_named(std::string_view name)
{
    for (const Named& named : all)
        if (name == named.name)
            return named.points();
    throw InputError(fmt::format("transfer function {}: unknown; known are {}", name, fmt::join(names, ", ")));
}

} // namespace

std::span<const char* const> transfer_function_names()
{
    return names;
}

TransferFunction named_transfer_function(std::string_view name, double lowest, double highest, double unit_length)
{
    NamedPoints named = points_named(name);
    if (!std::isfinite(lowest) || !std::isfinite(highest) || lowest > highest)
        throw InputError(
            fmt::format("transfer function {}: scalars from {} to {} are no range", name, lowest, highest));
    if (!std::isfinite(unit_length) || unit_length <= 0)
        throw InputError(
            fmt::format("transfer function {}: unit length {} must be above 0 and finite", name, unit_length));
    if (lowest == highest)
        named.resize(1);
    std::vector<OpticalPoint> points;
    for (const NamedPoint& point : named)
        points.push_back(
            {std::lerp(lowest, highest, point.position), extinction_of(point.opacity, unit_length), point.colour});
    return TransferFunction(std::move(points));
}

TransferFunction named_transfer_function(std::string_view name, const Scene& scene, double unit_length)
{
    const auto scalars = scalar_interval(scene.mesh());
    if (!scalars)
        throw InputError("the mesh has no scalars to draw");
    return named_transfer_function(name, scalars->lowest, scalars->highest, unit_length);
}

} // namespace visorder
