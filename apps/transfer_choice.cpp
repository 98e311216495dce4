#include "apps/transfer_choice.h"

#include "apps/number_check.h"
#include "files/transfer_function_file.h"
#include "scene/scalar_interval.h"
#include "visorder/error.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <utility>

namespace visorder::apps {

using namespace detail;

namespace {

// A function of a file's scalars, over the scalars that the mesh has for them.
TransferFunction stored(const TransferFunction& of_values, const ScalarMap& map)
{
    std::vector<OpticalPoint> points(of_values.points().begin(), of_values.points().end());
    for (OpticalPoint& point : points)
        point.scalar = map.stored(point.scalar);
    return TransferFunction(std::move(points));
}

struct NamedMap {
    std::filesystem::path file;
    std::string map; // empty: none is named
};

// A name may have an @ of its own: it is that of a file if there is one.
std::optional<NamedMap> named_map(const std::string& name)
{
    if (std::filesystem::exists(name))
        return NamedMap{name, {}};
    const std::size_t at = name.rfind('@');
    if (at == std::string::npos || !std::filesystem::exists(name.substr(0, at)))
        return std::nullopt;
    return NamedMap{name.substr(0, at), name.substr(at + 1)};
}

TransferFunction function_of_file(const TransferChoice& choice, NamedMap named, const Scene& scene,
                                  const ScalarMap& map, std::vector<std::string>& notes)
{
    if (!choice.map.empty()) {
        if (!named.map.empty() && named.map != choice.map)
            throw InputError(
                fmt::format("--transfer {} names the colour map {}, and --map {}", choice.name, named.map, choice.map));
        named.map = choice.map;
    }
    TransferFunctionFileOptions options;
    options.unit_length = unit_length_of(choice, scene);
    options.map = named.map;
    options.first_map = true;
    if (choice.map_range == "data")
        options.spread = scalar_interval(scene.mesh());
    if (options.spread)
        options.spread = {map.value(options.spread->lowest), map.value(options.spread->highest)};
    TransferFunction result = stored(read_transfer_function(named.file, options), map);
    if (named.map.empty())
        if (const std::vector<std::string> names = colour_map_names(named.file); names.size() > 1)
            notes.push_back(fmt::format("{} holds {} colour maps: the first{} is taken; --transfer FILE@NAME takes "
                                        "another",
                                        named.file.string(), names.size(),
                                        names.front().empty() ? std::string() : ", " + names.front() + ","));
    return result;
}

} // namespace

std::shared_ptr<TransferChoice> add_transfer_choice(CLI::App& command)
{
    auto choice = std::make_shared<TransferChoice>();
    command
        .add_option("--transfer", choice->name,
                    fmt::format("Transfer function: a JSON file, visorder's or ParaView's (FILE@NAME: of several "
                                "colour maps the one of that name), or one of {}",
                                fmt::join(transfer_function_names(), ", ")))
        ->capture_default_str();
    command.add_option("--map", choice->map, "The colour map to take from a ParaView file of several (default: first)");
    command
        .add_option("--map-range", choice->map_range,
                    "Spread a ParaView file's colour map over the data, or take its scalars as in the file")
        ->capture_default_str()
        ->check(CLI::IsMember({"data", "file"}));
    command
        .add_option("--unit-length", choice->unit_length,
                    "The distance over which opacities hold (default: a tenth of the scene's diameter)")
        ->check(positive());
    return choice;
}

double unit_length_of(const TransferChoice& choice, const Scene& scene)
{
    return choice.unit_length != 0 ? choice.unit_length : scene.diameter() / 10;
}

TransferFunction transfer_function_of(const TransferChoice& choice, const Scene& scene, const ScalarMap& map,
                                      std::vector<std::string>& notes)
{
    const auto names = transfer_function_names();
    if (std::find(names.begin(), names.end(), choice.name) == names.end()) {
        const std::optional<NamedMap> named = named_map(choice.name);
        if (!named)
            throw InputError(fmt::format("{}: neither a file nor a transfer function; there are: {}", choice.name,
                                         fmt::join(names, ", ")));
        return function_of_file(choice, *named, scene, map, notes);
    }
    const std::optional<ScalarInterval> scalars = scalar_interval(scene.mesh());
    // What a function has at its lowest scalar is mostly nothing.
    const bool all_equal = scalars && scalars->lowest == scalars->highest;
    return named_transfer_function(all_equal ? "constant" : choice.name, scene, unit_length_of(choice, scene));
}

} // namespace visorder::apps
