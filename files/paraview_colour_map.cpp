#include "files/paraview_colour_map.h"

#include "optics/colour_space.h"
#include "optics/srgb.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace visorder::detail {

namespace {

using nlohmann::json;

constexpr double most_opacity = 0.999;
constexpr double opacity_of_categories = 0.3; // where a map says none
// How far a part may be from the map at any of the samples that are taken of it, in opacity and in each channel of the
// colour, linear as well as sRGB; how much farther where parts are joined, and how many of
// them; and how often a part is halved at most.
constexpr double tolerance = 4.5e-4;
constexpr double joining_tolerance = 2.5e-4;
constexpr std::size_t most_joined = 64;
constexpr int samples = 7;
constexpr int most_halvings = 14;

struct ColourNode {
    double scalar;
    glm::dvec3 colour; // sRGB
};
struct OpacityNode {
    double scalar;
    double opacity;
    double midpoint = 0.5; // where on the way to the next node half the change is made
    double sharpness = 0;  // from 0, linear, to 1, a step
};

struct ColourMap {
    std::vector<ColourNode> colours; // ascending by scalar
    ColourSpace space = ColourSpace::rgb;
    std::vector<OpacityNode> opacities;
    bool says_opacity = false;
    bool holds_as_it_stands = false; // for what it is of are values, not parts of a range
};

bool is_set(const json& map, const char* key)
{
    return map.contains(key) && (map.at(key) == json(true) || map.at(key) == json(1));
}

// The rows of `count` numbers that an array holds one after the other.
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
    return result;
}

template <std::size_t count>
void check_ascending(const std::vector<std::array<double, count>>& points, const char* key)
{
    for (std::size_t i = 1; i < points.size(); ++i)
        if (points[i][0] < points[i - 1][0])
            throw InputError(fmt::format("{}, point {}: scalar {} does not ascend", key, i, points[i][0]));
    if (!std::isfinite(points.back()[0] - points.front()[0]))
        throw InputError(
            fmt::format("{}: scalar {} is too far from {}, the first", key, points.back()[0], points.front()[0]));
}

glm::dvec3 checked_colour(const char* key, std::size_t point, double red, double green, double blue)
{
    if (const auto [low, high] = std::minmax({red, green, blue}); low < 0 || high > 1)
        throw InputError(
            fmt::format("{}, point {}: colour ({}, {}, {}) must lie in [0, 1]", key, point, red, green, blue));
    return {red, green, blue};
}

std::vector<ColourNode> colours_of(const json& map)
{
    const auto points = rows<4>(map, "RGBPoints");
    check_ascending(points, "RGBPoints");
    std::vector<ColourNode> colours;
    for (const auto& [scalar, red, green, blue] : points)
        colours.push_back({scalar, checked_colour("RGBPoints", colours.size(), red, green, blue)});
    return colours;
}

std::vector<OpacityNode> opacities_of(const json& map)
{
    const auto points = rows<4>(map, "Points");
    check_ascending(points, "Points");
    std::vector<OpacityNode> opacities;
    for (const auto& [scalar, opacity, midpoint, sharpness] : points) {
        const std::size_t point = opacities.size();
        if (opacity < 0 || opacity > 1)
            throw InputError(fmt::format("Points, point {}: opacity {} must lie in [0, 1]", point, opacity));
        if (midpoint < 0 || midpoint > 1)
            throw InputError(fmt::format("Points, point {}: midpoint {} must lie in [0, 1]", point, midpoint));
        if (sharpness < 0 || sharpness > 1)
            throw InputError(fmt::format("Points, point {}: sharpness {} must lie in [0, 1]", point, sharpness));
        // As VTK does, so that nothing is divided by zero.
        opacities.push_back({scalar, opacity, std::clamp(midpoint, 0.00001, 0.99999), sharpness});
    }
    return opacities;
}

// The values that categories are of, in the order of their colours; none where one of them is no number.
std::vector<double> annotated_values(const json& map)
{
    std::vector<double> values;
    if (!map.contains("Annotations") || !map.at("Annotations").is_array())
        return values;
    const json& annotations = map.at("Annotations"); // value, text, value, text, ...
    for (std::size_t i = 0; i + 1 < annotations.size(); i += 2) {
        double value = 0;
        if (annotations[i].is_number()) {
            value = annotations[i].get<double>();
        } else if (annotations[i].is_string()) {
            const auto text = annotations[i].get<std::string>();
            char* end = nullptr;
            value = std::strtod(text.c_str(), &end);
            if (end == text.c_str() || *end != '\0')
                return {};
        } else {
            return {};
        }
        if (!std::isfinite(value))
            return {};
        values.push_back(value);
    }
    return values;
}

// From the range of some opacities to [0, 1], the range of categories without values.
void spread_over_parts(std::vector<OpacityNode>& opacities)
{
    const double first = opacities.front().scalar, last = opacities.back().scalar;
    for (OpacityNode& node : opacities)
        node.scalar = last > first ? (node.scalar - first) / (last - first) : 0;
}

// A step from one category to the next. Around values, a step lies half way between two of them; without values, the
// range is cut into equal parts, from 0 to 1 until it is spread.
void add_categories(const json& map, ColourMap& result)
{
    const auto colours = rows<3>(map, "IndexedColors");
    std::vector<double> values = annotated_values(map);
    result.holds_as_it_stands = !values.empty();
    if (values.empty()) {
        for (std::size_t i = 0; i < colours.size(); ++i)
            values.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(colours.size()));
    }
    std::vector<ColourNode> categories;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t at = i % colours.size(); // as in ParaView, where there are too few colours
        categories.push_back(
            {values[i], checked_colour("IndexedColors", at, colours[at][0], colours[at][1], colours[at][2])});
    }
    std::stable_sort(categories.begin(), categories.end(),
                     [](const ColourNode& a, const ColourNode& b) { return a.scalar < b.scalar; });
    const bool cuts = !result.holds_as_it_stands;
    result.space = ColourSpace::step;
    result.colours.push_back({cuts ? 0 : categories.front().scalar, categories.front().colour});
    for (std::size_t i = 0; i + 1 < categories.size(); ++i)
        result.colours.push_back({cuts ? (static_cast<double>(i) + 1) / static_cast<double>(categories.size())
                                       : std::midpoint(categories[i].scalar, categories[i + 1].scalar),
                                  categories[i].colour});
    result.colours.push_back({cuts ? 1 : categories.back().scalar, categories.back().colour});
}

ColourSpace space_of(const json& map)
{
    if (!map.contains("ColorSpace"))
        return ColourSpace::rgb;
    const json& space = map.at("ColorSpace");
    std::string name = space.is_string() ? space.get<std::string>() : space.dump();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (name == "hsv")
        return is_set(map, "HSVWrap") ? ColourSpace::hsv_wrapped : ColourSpace::hsv;
    constexpr std::array<std::pair<const char*, ColourSpace>, 6> spaces{{{"rgb", ColourSpace::rgb},
                                                                         {"lab", ColourSpace::lab},
                                                                         {"cielab", ColourSpace::lab},
                                                                         {"lab/ciede2000", ColourSpace::lab},
                                                                         {"diverging", ColourSpace::diverging},
                                                                         {"step", ColourSpace::step}}};
    for (const auto& [known, result] : spaces)
        if (name == known)
            return result;
    throw InputError(
        fmt::format("ColorSpace {} is not supported, only RGB, HSV, Lab, CIELAB, Diverging and Step", space.dump()));
}

ColourMap colour_map(const json& map)
{
    ColourMap result;
    const bool has_categories = map.contains("IndexedColors") && !map.at("IndexedColors").empty();
    const bool categories = has_categories && (!map.contains("RGBPoints") || is_set(map, "IndexedLookup"));
    if (!categories && !map.contains("RGBPoints"))
        throw InputError("there is no RGBPoints, and no IndexedColors");
    if (!categories && map.contains("UseLogScale") && map.at("UseLogScale") != json(0) &&
        map.at("UseLogScale") != json(false))
        throw InputError("UseLogScale is not supported");
    if (categories) {
        add_categories(map, result);
    } else {
        result.colours = colours_of(map);
        result.space = space_of(map);
    }
    const double first = result.colours.front().scalar, last = result.colours.back().scalar;
    result.says_opacity = map.contains("Points") && !map.at("Points").is_null();
    if (result.says_opacity) {
        result.opacities = opacities_of(map);
        if (categories && !result.holds_as_it_stands)
            spread_over_parts(result.opacities);
    } else if (categories)
        result.opacities = {{first, opacity_of_categories}};
    else
        result.opacities = {{first, 0}, {last, 1}};
    return result;
}

// The share of the way from a node to the next at which VTK's functions are, a part `t` of it on; `before` the midpoint
// or behind it.
double moved_to_midpoint(double t, double midpoint, bool before)
{
    return before ? 0.5 * t / midpoint : 0.5 + 0.5 * (t - midpoint) / (1 - midpoint);
}

double opacity_between(const OpacityNode& from, const OpacityNode& to, double t, bool before)
{
    const double a = from.opacity, b = to.opacity, sharpness = from.sharpness;
    double s = moved_to_midpoint(t, from.midpoint, before);
    if (sharpness > 0.99)
        return before ? a : b;
    if (sharpness < 0.01)
        return (1 - s) * a + s * b;
    // A Hermite curve, the flatter at its ends and the steeper in its middle the sharper it is.
    s = before ? 0.5 * std::pow(2 * s, 1 + 10 * sharpness) : 1 - 0.5 * std::pow(2 * (1 - s), 1 + 10 * sharpness);
    const double square = s * s, cube = square * s;
    const double slope = (1 - sharpness) * (b - a);
    const double value = (2 * cube - 3 * square + 1) * a + (3 * square - 2 * cube) * b +
                         (cube - 2 * square + s) * slope + (cube - square) * slope;
    return std::clamp(value, std::min(a, b), std::max(a, b));
}

double part_between(double from, double to, double scalar)
{
    return std::clamp((scalar - from) / (to - from), 0.0, 1.0);
}

template <class Node>
std::size_t first_above(const std::vector<Node>& nodes, double scalar)
{
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), scalar,
                                        [](double value, const Node& node) { return value < node.scalar; });
    return static_cast<std::size_t>(above - nodes.begin());
}

// What a map has between two scalars with no node and no midpoint between them: one formula, and at both ends the value
// that it has coming from within.
class Stretch {
public:
    Stretch(const ColourMap& map, double from, double to, double unit_length) : map_(map), unit_length_(unit_length)
    {
        const double inside = std::midpoint(from, to);
        next_colour_ = first_above(map.colours, inside);
        next_opacity_ = first_above(map.opacities, inside);
        if (next_opacity_ > 0 && next_opacity_ < map.opacities.size()) {
            const OpacityNode& before = map.opacities[next_opacity_ - 1];
            const OpacityNode& after = map.opacities[next_opacity_];
            before_midpoint_ = part_between(before.scalar, after.scalar, inside) < before.midpoint;
        }
    }

    glm::dvec3 colour(double scalar) const // sRGB
    {
        const auto& nodes = map_.colours;
        if (next_colour_ == 0)
            return nodes.front().colour;
        if (next_colour_ == nodes.size())
            return nodes.back().colour;
        const ColourNode& a = nodes[next_colour_ - 1];
        const ColourNode& b = nodes[next_colour_];
        return glm::clamp(between(map_.space, a.colour, b.colour, part_between(a.scalar, b.scalar, scalar)), 0.0, 1.0);
    }

    double opacity(double scalar) const
    {
        const auto& nodes = map_.opacities;
        if (next_opacity_ == 0)
            return capped(nodes.front().opacity);
        if (next_opacity_ == nodes.size())
            return capped(nodes.back().opacity);
        const OpacityNode& a = nodes[next_opacity_ - 1];
        const OpacityNode& b = nodes[next_opacity_];
        return capped(opacity_between(a, b, part_between(a.scalar, b.scalar, scalar), before_midpoint_));
    }

    OpticalPoint point(double scalar) const
    {
        return {scalar, extinction_of(opacity(scalar), unit_length_), linear_of_srgb(colour(scalar))};
    }

    // Whether a straight line between two points is near enough all that is between them.
    bool is_straight(const OpticalPoint& from, const OpticalPoint& to) const
    {
        for (int sample = 1; sample <= samples; ++sample) {
            const double t = sample / (samples + 1.0);
            const double scalar = std::lerp(from.scalar, to.scalar, t);
            const glm::dvec3 srgb = colour(scalar);
            const glm::dvec3 linear = linear_of_srgb(srgb);
            const glm::dvec3 drawn = glm::mix(from.colour, to.colour, t);
            const double hidden = -std::expm1(-std::lerp(from.extinction, to.extinction, t) * unit_length_);
            if (!(std::abs(hidden - opacity(scalar)) <= tolerance))
                return false;
            for (int k = 0; k < 3; ++k)
                if (!(std::abs(drawn[k] - linear[k]) <= tolerance) ||
                    !(std::abs(srgb_of_linear(drawn[k]) - srgb[k]) <= tolerance))
                    return false;
        }
        return true;
    }

private:
    static double capped(double opacity) { return std::min(most_opacity, opacity); }

    const ColourMap& map_;
    double unit_length_;
    std::size_t next_colour_;
    std::size_t next_opacity_;
    bool before_midpoint_ = false;
};

// Appends a point; of those at one scalar, the first and the last are kept, and of equal ones one.
void append(std::vector<OpticalPoint>& points, const OpticalPoint& point)
{
    const std::size_t count = points.size();
    const auto is_at = [&](std::size_t i) { return points[i].scalar == point.scalar; };
    if (count > 0 && is_at(count - 1) && points.back().extinction == point.extinction &&
        points.back().colour == point.colour)
        return;
    if (count > 1 && is_at(count - 1) && is_at(count - 2))
        points.back() = point;
    else
        points.push_back(point);
}

// Appends what follows `from`, up to `to`.
void append_stretch(std::vector<OpticalPoint>& points, const Stretch& stretch, const OpticalPoint& from,
                    const OpticalPoint& to, int halvings)
{
    const double middle = std::midpoint(from.scalar, to.scalar);
    if (halvings > 0 && from.scalar < middle && middle < to.scalar && !stretch.is_straight(from, to)) {
        const OpticalPoint half = stretch.point(middle);
        append_stretch(points, stretch, from, half, halvings - 1);
        append_stretch(points, stretch, half, to, halvings - 1);
    } else {
        append(points, to);
    }
}

// Where a formula of opacity ends and another begins, ascending.
std::vector<double> opacity_breaks_of(const ColourMap& map)
{
    std::vector<double> breaks;
    for (std::size_t i = 0; i < map.opacities.size(); ++i) {
        if (i > 0)
            breaks.push_back(
                std::lerp(map.opacities[i - 1].scalar, map.opacities[i].scalar, map.opacities[i - 1].midpoint));
        breaks.push_back(map.opacities[i].scalar);
    }
    return breaks;
}

// How far apart two points are, in what the tolerance is of.
double difference(const OpticalPoint& a, const OpticalPoint& b, double unit_length)
{
    double most = std::abs(std::expm1(-a.extinction * unit_length) - std::expm1(-b.extinction * unit_length));
    for (int k = 0; k < 3; ++k)
        most = std::max({most, std::abs(a.colour[k] - b.colour[k]),
                         std::abs(srgb_of_linear(a.colour[k]) - srgb_of_linear(b.colour[k]))});
    return most;
}

bool is_jump(const std::vector<OpticalPoint>& points, std::size_t i)
{
    return points[i - 1].scalar == points[i].scalar || points[i].scalar == points[i + 1].scalar;
}

// Leaves out points of colours alone that their neighbours make up for: some maps have hundreds, and a renderer draws
// every part between two points.
std::vector<OpticalPoint> without_needless(const std::vector<OpticalPoint>& points, const ColourMap& map,
                                           double unit_length)
{
    const auto is_of_opacity = [&, breaks = opacity_breaks_of(map)](double scalar) {
        return std::binary_search(breaks.begin(), breaks.end(), scalar);
    };
    const auto are_needless = [&](std::size_t first, std::size_t next) {
        const OpticalPoint &a = points[first], &b = points[next];
        for (std::size_t i = first + 1; i < next; ++i) {
            const double t = (points[i].scalar - a.scalar) / (b.scalar - a.scalar);
            const OpticalPoint drawn{points[i].scalar, std::lerp(a.extinction, b.extinction, t),
                                     glm::mix(a.colour, b.colour, t)};
            if (!(difference(drawn, points[i], unit_length) <= joining_tolerance))
                return false;
        }
        return true;
    };
    std::vector<OpticalPoint> result{points.front()};
    for (std::size_t kept = 0; kept + 1 < points.size();) {
        std::size_t next = kept + 1;
        while (next + 1 < points.size() && next - kept < most_joined && !is_jump(points, next) &&
               !is_of_opacity(points[next].scalar) && are_needless(kept, next + 1))
            ++next;
        result.push_back(points[next]);
        kept = next;
    }
    return result;
}

// All scalars where one formula ends and another begins, ascending, each once.
std::vector<double> breaks_of(const ColourMap& map)
{
    std::vector<double> breaks;
    for (std::size_t i = 0; i < map.colours.size(); ++i) {
        breaks.push_back(map.colours[i].scalar);
        if (i > 0 && map.space == ColourSpace::diverging) // there may be white half way
            breaks.push_back(std::midpoint(map.colours[i - 1].scalar, map.colours[i].scalar));
    }
    const std::vector<double> of_opacities = opacity_breaks_of(map);
    breaks.insert(breaks.end(), of_opacities.begin(), of_opacities.end());
    std::sort(breaks.begin(), breaks.end());
    breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
    return breaks;
}

std::vector<OpticalPoint> points_of(const ColourMap& map, double unit_length)
{
    const std::vector<double> breaks = breaks_of(map);
    const auto end = [&](double scalar, const ColourNode& colour, const OpacityNode& opacity) {
        return OpticalPoint{scalar, extinction_of(std::min(most_opacity, opacity.opacity), unit_length),
                            linear_of_srgb(colour.colour)};
    };
    std::vector<OpticalPoint> points;
    append(points, end(breaks.front(), map.colours.front(), map.opacities.front()));
    for (std::size_t i = 1; i < breaks.size(); ++i) {
        const Stretch stretch(map, breaks[i - 1], breaks[i], unit_length);
        const OpticalPoint from = stretch.point(breaks[i - 1]), to = stretch.point(breaks[i]);
        append(points, from);
        append_stretch(points, stretch, from, to, most_halvings);
    }
    append(points, end(breaks.back(), map.colours.back(), map.opacities.back()));
    return without_needless(points, map, unit_length);
}

// From the range of the map's colours to an interval; for an interval of one scalar, what is at the lowest.
std::vector<OpticalPoint> spread(const std::vector<OpticalPoint>& points, const ColourMap& map,
                                 const ScalarInterval& over, double unit_length)
{
    const double first = map.colours.front().scalar, last = map.colours.back().scalar;
    if (map.holds_as_it_stands || first == last)
        return points;
    if (over.lowest == over.highest) {
        OpticalPoint only = TransferFunction(points).at(first);
        only.scalar = over.lowest;
        if (!map.says_opacity) // what rises from nothing would not be seen
            only.extinction = extinction_of(opacity_of_categories, unit_length);
        return {only};
    }
    std::vector<OpticalPoint> result;
    for (OpticalPoint point : points) {
        point.scalar = std::lerp(over.lowest, over.highest, (point.scalar - first) / (last - first));
        append(result, point);
    }
    return result;
}

} // namespace

TransferFunction transfer_function_of_paraview(const json& map, const TransferFunctionFileOptions& options)
{
    const ColourMap colours = colour_map(map);
    std::vector<OpticalPoint> points = points_of(colours, options.unit_length);
    if (options.spread)
        points = spread(points, colours, *options.spread, options.unit_length);
    return TransferFunction(std::move(points));
}

} // namespace visorder::detail
