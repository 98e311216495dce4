#include "projection/paraview_colour_map.h"

#include "scene/error.h"
#include "scene/srgb.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace visorder {

namespace {

using nlohmann::json;

constexpr double most_opacity = 0.999;
constexpr int parts = 16; // that follow a slope of opacity

template <class Value>
struct Knot {
    double scalar;
    Value value;
};
template <class Value>
using Knots = std::vector<Knot<Value>>;

// The rows of `count` numbers that an array holds one after the other, their scalars ascending.
template <std::size_t count>
std::vector<std::array<double, count>> rows(const json& map, const char* key)
{
    const json& array = map.at(key);
    if (!array.is_array() || array.empty() || array.size() % count != 0)
        throw InputError(fmt::format("{} must be an array of {} numbers a point", key, count));
    std::vector<std::array<double, count>> result(array.size() / count);
    for (std::size_t i = 0; i < array.size(); ++i) {
        if (!array[i].is_number())
            throw InputError(fmt::format("{}, point {}: {} is not a number", key, i / count, array[i].dump()));
        result[i / count][i % count] = array[i].get<double>();
    }
    for (std::size_t i = 1; i < result.size(); ++i)
        if (result[i][0] < result[i - 1][0] || (i >= 2 && result[i][0] == result[i - 2][0]))
            throw InputError(fmt::format("{}, point {}: scalar {} does not ascend", key, i, result[i][0]));
    return result;
}

Knots<glm::dvec3> colours_of(const json& map)
{
    Knots<glm::dvec3> colours;
    for (const auto& [scalar, red, green, blue] : rows<4>(map, "RGBPoints")) {
        if (const auto [low, high] = std::minmax({red, green, blue}); low < 0 || high > 1)
            throw InputError(fmt::format("RGBPoints, point {}: colour ({}, {}, {}) must lie in [0, 1]", colours.size(),
                                         red, green, blue));
        colours.push_back({scalar, linear_of_srgb(glm::dvec3(red, green, blue))});
    }
    return colours;
}

Knots<double> opacities_of(const json& map, const Knots<glm::dvec3>& colours)
{
    if (!map.contains("Points") || map.at("Points").is_null())
        return {{colours.front().scalar, 0.0}, {colours.back().scalar, 1.0}};
    Knots<double> opacities;
    for (const auto& [scalar, opacity, midpoint, sharpness] : rows<4>(map, "Points")) {
        const std::size_t point = opacities.size();
        if (opacity < 0 || opacity > 1)
            throw InputError(fmt::format("Points, point {}: opacity {} must lie in [0, 1]", point, opacity));
        if (midpoint != 0.5 || sharpness != 0)
            throw InputError(fmt::format("Points, point {}: midpoint {} and sharpness {} are not supported, only 0.5 "
                                         "and 0",
                                         point, midpoint, sharpness));
        opacities.push_back({scalar, opacity});
    }
    return opacities;
}

enum class Side { below, above };

// The value at a scalar, coming from one side of it.
template <class Value>
Value value_at(const Knots<Value>& knots, double scalar, Side side)
{
    const auto next = std::find_if(knots.begin(), knots.end(), [&](const Knot<Value>& knot) {
        return side == Side::below ? knot.scalar >= scalar : knot.scalar > scalar;
    });
    if (next == knots.begin())
        return knots.front().value;
    if (next == knots.end())
        return knots.back().value;
    const Knot<Value>& before = *(next - 1);
    const double t = (scalar - before.scalar) / (next->scalar - before.scalar);
    return (1 - t) * before.value + t * next->value;
}

// From 0 to 1 to an interval; an interval of one scalar gets what is at 0.
template <class Value>
void spread(Knots<Value>& knots, const ScalarInterval& over)
{
    if (over.lowest == over.highest)
        knots = {{0, value_at(knots, 0, Side::above)}};
    for (Knot<Value>& knot : knots)
        knot.scalar = std::lerp(over.lowest, over.highest, knot.scalar);
}

// All scalars that a point is needed at, ascending, each once.
std::vector<double> scalars_of(const Knots<glm::dvec3>& colours, const Knots<double>& opacities)
{
    std::vector<double> scalars;
    for (const auto& knot : colours)
        scalars.push_back(knot.scalar);
    for (std::size_t i = 0; i < opacities.size(); ++i) {
        scalars.push_back(opacities[i].scalar);
        if (i > 0 && opacities[i].value != opacities[i - 1].value)
            for (int part = 1; part < parts; ++part)
                scalars.push_back(std::lerp(opacities[i - 1].scalar, opacities[i].scalar, part * 1.0 / parts));
    }
    std::sort(scalars.begin(), scalars.end());
    scalars.erase(std::unique(scalars.begin(), scalars.end()), scalars.end());
    return scalars;
}

void check_interpolation(const json& map)
{
    if (!map.contains("RGBPoints"))
        throw InputError("there is no RGBPoints");
    if (map.contains("UseLogScale") && map.at("UseLogScale") != json(0) && map.at("UseLogScale") != json(false))
        throw InputError("UseLogScale is not supported");
    if (!map.contains("ColorSpace"))
        return;
    const json& space = map.at("ColorSpace");
    std::string name = space.is_string() ? space.get<std::string>() : space.dump();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const char* known : {"rgb", "lab", "cielab", "lab/ciede2000", "diverging"})
        if (name == known)
            return;
    throw InputError(fmt::format("ColorSpace {} is not supported, only RGB, Lab and Diverging", space.dump()));
}

} // namespace

TransferFunction transfer_function_of_paraview(const json& map, const TransferFunctionFileOptions& options)
{
    check_interpolation(map);
    Knots<glm::dvec3> colours = colours_of(map);
    Knots<double> opacities = opacities_of(map, colours);
    if (options.spread && colours.front().scalar == 0 && colours.back().scalar == 1) {
        spread(colours, *options.spread);
        spread(opacities, *options.spread);
    }
    std::vector<OpticalPoint> points;
    for (const double scalar : scalars_of(colours, opacities)) {
        const auto point = [&](Side side) {
            const double opacity = std::min(most_opacity, value_at(opacities, scalar, side));
            return OpticalPoint{scalar, extinction_of(opacity, options.unit_length),
                                glm::clamp(value_at(colours, scalar, side), 0.0, 1.0)};
        };
        const OpticalPoint below = point(Side::below), above = point(Side::above);
        points.push_back(below);
        if (above.extinction != below.extinction || above.colour != below.colour)
            points.push_back(above);
    }
    return TransferFunction(std::move(points));
}

} // namespace visorder
