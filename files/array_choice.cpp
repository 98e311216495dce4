#include "files/array_choice.h"

#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <optional>

namespace visorder::detail {

namespace {

std::string listed(const std::vector<FileArray>& arrays)
{
    std::vector<std::string> names;
    for (const FileArray& array : arrays)
        names.push_back(array.name + (array.on_cells ? " (of cells)" : ""));
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

template <class Wanted>
const FileArray* first_of(const FileGrid& grid, const Wanted& wanted)
{
    for (const bool on_cells : {false, true})
        for (const FileArray& array : grid.arrays)
            if (array.on_cells == on_cells && wanted(array))
                return &array;
    return nullptr;
}

// Not all the same, and more than a count of the points or cells.
bool varies(const FileArray& array)
{
    const std::vector<double> values = array.values();
    const bool is_whole = !array.type.empty() && array.type != "float" && array.type != "double";
    const auto not_next = [](double value, double next) { return next != value + 1; };
    if (is_whole && std::adjacent_find(values.begin(), values.end(), not_next) == values.end())
        return false;
    const auto is_finite = [](double value) { return std::isfinite(value); };
    const auto first = std::find_if(values.begin(), values.end(), is_finite);
    return std::any_of(first, values.end(), [&](double value) { return is_finite(value) && value != *first; });
}

} // namespace

const FileArray* choose_array(const FileGrid& grid, const std::string& name)
{
    if (!name.empty()) {
        const FileArray* named = first_of(grid, [&](const FileArray& array) { return array.name == name; });
        if (!named)
            throw InputError(
                fmt::format("{}: no scalar \"{}\"; it has: {}", grid.path.string(), name, listed(grid.arrays)));
        return named;
    }
    const auto is_default = [&](const FileArray& array) { return array.name == grid.default_array && varies(array); };
    const auto is_active = [](const FileArray& array) { return array.active && !array.holds_ids; };
    const auto one_number = [](const FileArray& array) { return array.components == 1 && !array.holds_ids; };
    if (const FileArray* array = first_of(grid, is_default))
        return array;
    if (const FileArray* array = first_of(grid, is_active))
        return array;
    if (const FileArray* array = first_of(grid, [&](const FileArray& a) { return one_number(a) && varies(a); }))
        return array;
    if (const FileArray* array = first_of(grid, [](const FileArray& a) { return !a.holds_ids && varies(a); }))
        return array;
    if (const FileArray* array = first_of(grid, one_number))
        return array;
    return first_of(grid, [](const FileArray& array) { return !array.holds_ids; });
}

bool is_name_of_ids(std::string_view name)
{
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
    if (name == "vtkGhostType")
        return true;
    if (name.ends_with('s') || name.ends_with('S'))
        name.remove_suffix(1);
    constexpr std::array<std::string_view, 3> words{"id", "Id", "ID"};
    const auto word = std::find_if(words.begin(), words.end(), [&](auto w) { return name.ends_with(w); });
    if (word == words.end())
        return false;
    name.remove_suffix(2);
    // The word stands alone, or its capital parts it from a small letter: "block_id", "GlobalNodeId", but not "fluid".
    return name.empty() || !is_letter(name.back()) || (*word != "id" && is_small(name.back()));
}

ArraySummary summary_of(const FileArray& array)
{
    ArraySummary summary{array.name, array.type, array.on_cells, array.components, array.holds_ids, 0, 0, 0, 0};
    for (const double value : array.values()) {
        if (!std::isfinite(value)) {
            ++summary.missing;
            continue;
        }
        summary.lowest = summary.finite == 0 ? value : std::min(summary.lowest, value);
        summary.highest = summary.finite == 0 ? value : std::max(summary.highest, value);
        ++summary.finite;
    }
    return summary;
}

ScalarMap scalar_map_of(std::span<const double> values)
{
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const double value : values)
        if (std::isfinite(value)) {
            lowest = std::min(lowest, value);
            highest = std::max(highest, value);
        }
    if (lowest > highest)
        return {};
    using Single = std::numeric_limits<float>;
    const double largest = std::max(std::abs(lowest), std::abs(highest));
    // Rounding moves a value by half a unit in its last place, and by as much as that of the least normal number.
    const double rounding = std::max(largest * Single::epsilon() / 2, double{Single::denorm_min()});
    const double half = highest / 2 - lowest / 2;
    constexpr double most_lost = 1e-5; // of the range
    if (largest <= double{Single::max()} && (half == 0 || rounding <= most_lost * 2 * half))
        return {};
    return {lowest / 2 + highest / 2, half > 0 ? half : 1};
}

} // namespace visorder::detail
