#include "files/plot3d_file.h"

#include "files/file_content.h"
#include "files/plot3d_layout.h"
#include "files/structured_cells.h"
#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace visorder::detail {

namespace {

/// The name of the solution on a grid.
std::filesystem::path solution_of(const std::filesystem::path& grid)
{
    std::string name = grid.filename().string();
    const auto ends = [&](std::string_view ending) {
        return name.size() >= ending.size() &&
               std::equal(ending.begin(), ending.end(), name.end() - static_cast<std::ptrdiff_t>(ending.size()),
                          [](char wanted, char c) { return wanted == (c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
    };
    std::string compressed;
    if (ends(".gz")) {
        compressed = name.substr(name.size() - 3);
        name.resize(name.size() - 3);
    }
    std::size_t coordinates = name.rfind('.') + 1;
    std::size_t length = name.size() - coordinates;
    if (ends("xyz.bin")) {
        length = 3;
        coordinates = name.size() - std::string_view("xyz.bin").size();
    }
    const bool capital = name[coordinates] >= 'A' && name[coordinates] <= 'Z';
    name.replace(coordinates, length, capital ? "Q" : "q");
    const std::filesystem::path plain = grid.parent_path() / name;
    const std::filesystem::path packed = grid.parent_path() / (name + (compressed.empty() ? ".gz" : compressed));
    return std::filesystem::exists(packed) && !std::filesystem::exists(plain) ? packed : plain;
}

std::string text_of(const glm::ivec3& size)
{
    return fmt::format("{} x {} x {}", size.x, size.y, size.z);
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what)
{
    throw InputError(fmt::format("{}: {}", path.string(), what));
}

Plot3dZones read_solution(const std::filesystem::path& path, const Plot3dZones& grid)
{
    std::string content = content_of_file(path);
    if (content.starts_with("\x1f\x8b"))
        content = decompressed(path, content);
    auto found = find_plot3d_zones(path, content, Plot3dContent::solution, grid.axes);
    if (!found)
        fail(path, "cannot be read: it is cut short, or not laid out as its grid is");
    if (found->zones.size() != grid.zones.size())
        fail(path, fmt::format("it has {} grids, not {} as its grid", found->zones.size(), grid.zones.size()));
    for (std::size_t i = 0; i < grid.zones.size(); ++i)
        if (found->zones[i].size != grid.zones[i].size)
            fail(path, fmt::format("its {} points are not the {} of its grid", text_of(found->zones[i].size),
                                   text_of(grid.zones[i].size)));
    return std::move(*found);
}

/// The magnitude of components [first, first + count) of the points' numbers.
std::vector<double> values_of(const Plot3dZones& solution, int first, int count)
{
    std::vector<double> values;
    for (const Plot3dZone& zone : solution.zones)
        for (std::size_t i = 0; i < zone.points(); ++i) {
            double squares = 0;
            for (int k = 0; k < count; ++k)
                squares += zone.real(i, first + k) * zone.real(i, first + k);
            values.push_back(count == 1 ? zone.real(i, first) : std::sqrt(squares));
        }
    return values;
}

} // namespace

FileGrid read_plot3d_file(const std::filesystem::path& path, std::string_view content)
{
    const auto found = find_plot3d_zones(path, content, Plot3dContent::grid, 0);
    if (!found)
        fail(path, "cannot be read: its length is that of no Plot3D file");
    FileGrid grid;
    grid.path = path;
    for (const Plot3dZone& zone : found->zones) {
        if (found->zones.size() > 1)
            grid.blocks.push_back({fmt::format("grid {}", grid.blocks.size() + 1), grid.cells.size()});
        grid.pieces.push_back(grid.points.size());
        for (std::size_t i = 0; i < zone.points(); ++i)
            grid.points.emplace_back(zone.real(i, 0), zone.real(i, 1), found->axes == 3 ? zone.real(i, 2) : 0.0);
        add_structured_cells(grid, zone.size, grid.pieces.back(),
                             [&](std::size_t point) { return !zone.blank.empty() && zone.blank[point]; });
    }

    const std::filesystem::path solution_path = solution_of(path);
    if (!std::filesystem::exists(solution_path)) {
        grid.notes.push_back(fmt::format("no scalars: there is no {}", solution_path.string()));
        return grid;
    }
    const auto solution = std::make_shared<Plot3dZones>(read_solution(solution_path, *found));
    const int axes = solution->axes;
    grid.arrays = {{"Density", false, 1, false, [=] { return values_of(*solution, 0, 1); }},
                   {"Momentum", false, axes, false, [=] { return values_of(*solution, 1, axes); }},
                   {"StagnationEnergy", false, 1, false, [=] { return values_of(*solution, 1 + axes, 1); }}};
    grid.default_array = "Density";
    return grid;
}

} // namespace visorder::detail
