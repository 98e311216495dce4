#include "apps/number_check.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>

namespace visorder::apps {

namespace {

template <class Number>
std::optional<Number> number(const std::string& text)
{
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

} // namespace

CLI::Validator between(double least, double most)
{
    const auto check = [=](const std::string& text) {
        const auto value = number<double>(text);
        return value && *value >= least && *value <= most
                   ? std::string()
                   : fmt::format("\"{}\" is not a number from {} to {}", text, least, most);
    };
    return {check, ""};
}

CLI::Validator positive()
{
    const auto check = [](const std::string& text) {
        const auto value = number<double>(text);
        return value && *value > 0 && std::isfinite(*value) ? std::string()
                                                            : fmt::format("\"{}\" is not a number above 0", text);
    };
    return {check, ""};
}

CLI::Validator count_from(unsigned least)
{
    const auto check = [=](const std::string& text) {
        const auto value = number<std::uint64_t>(text);
        return value && *value >= least && *value <= std::uint64_t{1} << 63
                   ? std::string()
                   : fmt::format("\"{}\" is not a whole number from {} on", text, least);
    };
    return {check, ""};
}

} // namespace visorder::apps
