#include "files/time_step.h"

#include "visorder/error.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>

namespace visorder::detail {

namespace {

template <class Number>
std::optional<Number> number(std::string_view text)
{
    Number value{};
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size())
        return {};
    return value;
}

/// A few of the times, and how many there are.
std::string listed(std::span<const double> times)
{
    constexpr std::size_t most = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(times.size(), most); ++i)
        text += fmt::format("{}{}", i == 0 ? "" : ", ", times[i]);
    return times.size() > most ? fmt::format("{}, ... {}", text, times.back()) : text;
}

std::optional<std::size_t> find(std::span<const double> times, const std::string& wanted)
{
    const std::size_t last = times.empty() ? 0 : times.size() - 1;
    if (wanted.empty() || wanted == "last")
        return last;
    if (wanted == "first")
        return 0;
    constexpr std::string_view index = "index:";
    if (wanted.starts_with(index)) {
        const auto step = number<std::size_t>(std::string_view(wanted).substr(index.size()));
        return step && *step <= last ? step : std::nullopt;
    }
    const auto time = number<double>(wanted);
    const auto found = time ? std::find(times.begin(), times.end(), *time) : times.end();
    return found == times.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - times.begin()));
}

} // namespace

std::size_t choose_time_step(const std::filesystem::path& path, std::span<const double> times,
                             const std::string& wanted, std::vector<std::string>& notes)
{
    const auto step = find(times, wanted);
    if (!step)
        throw InputError(times.empty()
                             ? fmt::format("{}: no time \"{}\": the file has no time steps", path.string(), wanted)
                             : fmt::format("{}: no time \"{}\"; its {} time steps are at {}", path.string(), wanted,
                                           times.size(), listed(times)));
    if (times.size() > 1)
        notes.push_back(fmt::format("time step {} (from 0) of {}, at time {}", *step, times.size(), times[*step]));
    return *step;
}

} // namespace visorder::detail
