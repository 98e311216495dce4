#include "files/array_choice.h"

#include "scene/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace visorder {

namespace {

std::string listed(const std::vector<FileArray>& arrays)
{
    std::vector<std::string> names;
    for (const FileArray& array : arrays)
        names.push_back(array.name + (array.on_cells ? " (of cells)" : ""));
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

} // namespace

const FileArray* choose_array(const FileGrid& grid, const std::string& name)
{
    const std::string& wanted = name.empty() ? grid.default_array : name;
    for (const bool on_cells : {false, true}) {
        const auto chosen = std::find_if(grid.arrays.begin(), grid.arrays.end(), [&](const FileArray& array) {
            return array.on_cells == on_cells &&
                   (wanted.empty() ? array.components == 1 && !array.holds_ids : array.name == wanted);
        });
        if (chosen != grid.arrays.end())
            return &*chosen;
    }
    if (!wanted.empty())
        throw InputError(
            fmt::format("{}: no scalar \"{}\"; it has: {}", grid.path.string(), wanted, listed(grid.arrays)));
    return nullptr;
}

} // namespace visorder
