#include "apps/weld_option.h"

#include <charconv>
#include <cmath>

namespace visorder::apps {

namespace {

bool is_number(const std::string& text, double& number)
{
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && stop == text.data() + text.size();
}

} // namespace

void add_weld_option(CLI::App& command, WeldOption& weld)
{
    const auto take = [&weld](const CLI::results_t& given) {
        weld.given = true;
        return is_number(given.front(), weld.tolerance) && std::isfinite(weld.tolerance) && weld.tolerance >= 0;
    };
    command
        .add_option("--weld", take,
                    "Join points with exactly equal coordinates or, given a number, within that distance of each other")
        ->type_name("[TOLERANCE]");
}

std::vector<std::string> with_joined_weld_tolerance(std::vector<std::string> arguments)
{
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (arguments[i] != "--weld")
            continue;
        double number = 0;
        const bool has_tolerance = i + 1 < arguments.size() && is_number(arguments[i + 1], number);
        arguments[i] += "=" + (has_tolerance ? arguments[i + 1] : std::string("0"));
        if (has_tolerance)
            arguments.erase(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
    return arguments;
}

} // namespace visorder::apps
