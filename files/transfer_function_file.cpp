#include "files/transfer_function_file.h"

#include "files/input_content.h"
#include "files/paraview_colour_map.h"
#include "files/printable.h"
#include "visorder/error.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <vector>

namespace visorder::detail {

namespace {

using nlohmann::json;

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28;
constexpr int most_depth = 50; // of arrays and objects within others, which messages are made of by recursion

// With spaces for commas that stand before the end of an array or an object, which the parser does not take.
void blank_trailing_commas(std::string& content)
{
    const std::size_t none = content.size();
    std::size_t comma = none; // with nothing but spaces and comments since
    char before = '[';        // the last that is neither, other than that comma
    for (std::size_t i = 0; i < content.size(); ++i) {
        const char c = content[i];
        if (std::isspace(static_cast<unsigned char>(c)) != 0)
            continue;
        if (c == '/' && content.compare(i, 2, "//") == 0) {
            i = std::min(content.find('\n', i), none - 1);
            continue;
        }
        if (c == '/' && content.compare(i, 2, "/*") == 0) {
            const std::size_t end = content.find("*/", i + 2);
            i = end == std::string::npos ? none - 1 : end + 1;
            continue;
        }
        if ((c == ']' || c == '}') && comma != none && before != '[' && before != '{')
            content[comma] = ' ';
        if (c == ',' && comma == none) {
            comma = i;
            continue;
        }
        comma = none;
        before = c;
        if (c == '"')
            for (++i; i < content.size() && content[i] != '"'; ++i)
                i += content[i] == '\\' ? 1 : 0;
    }
}

json parse(const std::filesystem::path& file)
{
    std::string content = input_content(file, most_bytes);
    blank_trailing_commas(content);
    const auto check_depth = [](int depth, json::parse_event_t, json&) {
        if (depth > most_depth)
            throw InputError(fmt::format("arrays and objects are nested more than {} deep", most_depth));
        return true;
    };
    try {
        return json::parse(content, check_depth, true, true);
    } catch (const json::exception& error) {
        const std::string message = error.what(); // [name of the error] what is wrong
        const std::size_t begin = message.find("] ");
        throw InputError("no JSON: " + printable(begin == std::string::npos ? message : message.substr(begin + 2)));
    }
}

double number(const json& point, const char* key)
{
    if (!point.is_object() || !point.contains(key) || !point.at(key).is_number())
        throw InputError(fmt::format("there is no number \"{}\"", key));
    return point.at(key).get<double>();
}

OpticalPoint point_of(const json& point)
{
    OpticalPoint result{number(point, "scalar"), number(point, "extinction"), {}};
    if (!point.contains("colour") || !point.at("colour").is_array() || point.at("colour").size() != 3)
        throw InputError("there are no three numbers \"colour\"");
    for (int k = 0; k < 3; ++k) {
        const json& channel = point.at("colour").at(static_cast<std::size_t>(k));
        if (!channel.is_number())
            throw InputError(fmt::format("{} of \"colour\" is not a number", channel.dump()));
        result.colour[k] = channel.get<double>();
    }
    return result;
}

TransferFunction own(const json& content)
{
    if (!content.contains("points") || !content.at("points").is_array())
        throw InputError("there is no array \"points\"");
    std::vector<OpticalPoint> points;
    for (const json& point : content.at("points")) {
        try {
            points.push_back(point_of(point));
        } catch (const InputError& error) {
            throw InputError(fmt::format("point {}: {}", points.size(), error.what()));
        }
    }
    return TransferFunction(std::move(points));
}

std::string name_of(const json& map)
{
    return map.is_object() && map.contains("Name") && map.at("Name").is_string() ? map.at("Name").get<std::string>()
                                                                                 : "";
}

const json& chosen(const json& maps, const TransferFunctionFileOptions& options)
{
    const std::string& name = options.map;
    if ((maps.size() == 1 || options.first_map) && name.empty())
        return maps.front();
    std::vector<std::string> names;
    for (const json& map : maps) {
        if (!name.empty() && name_of(map) == name)
            return map;
        names.push_back(name_of(map));
    }
    throw InputError(
        name.empty() ? fmt::format("there are {} colour maps to choose from: {}", maps.size(), fmt::join(names, ", "))
                     : fmt::format("there is no colour map {}, only {}", name, fmt::join(names, ", ")));
}

TransferFunction transfer_function_of(const json& content, const TransferFunctionFileOptions& options)
{
    if (content.is_object())
        return own(content);
    if (!content.is_array() || content.empty())
        throw InputError("neither an object with \"points\" nor an array of colour maps");
    const json& map = chosen(content, options);
    if (!map.is_object())
        throw InputError("a colour map must be an object");
    return transfer_function_of_paraview(map, options);
}

} // namespace

TransferFunction read_transfer_function(const std::filesystem::path& file, const TransferFunctionFileOptions& options)
{
    if (!std::isfinite(options.unit_length) || options.unit_length <= 0)
        throw InputError(fmt::format("unit length {} must be above 0 and finite", options.unit_length));
    if (const auto& spread = options.spread;
        spread &&
        !(std::isfinite(spread->lowest) && std::isfinite(spread->highest) && spread->lowest <= spread->highest))
        throw InputError(fmt::format("scalars from {} to {} are no range", spread->lowest, spread->highest));
    try {
        return transfer_function_of(parse(file), options);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", file.string(), error.what()));
    }
}

std::vector<std::string> colour_map_names(const std::filesystem::path& file)
{
    try {
        const json content = parse(file);
        std::vector<std::string> names;
        if (content.is_array())
            for (const json& map : content)
                names.push_back(name_of(map));
        return names;
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", file.string(), error.what()));
    }
}

} // namespace visorder::detail
