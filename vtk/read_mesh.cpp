#include "vtk/read_mesh.h"

#include "scene/error.h"
#include "vtk/data_set_mesh.h"
#include "vtk/obj_file.h"
#include "vtk/unused_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>

namespace visorder {

namespace {

constexpr std::array endings{".vtu", ".vtk", ".ex2", ".e", ".exo", "xyz.bin", ".obj"};

/// Which of the endings a name has, whatever the case of its letters; null for none.
const char* ending_of(std::string name)
{
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    const auto ending = std::find_if(endings.begin(), endings.end(), [&](const char* e) { return name.ends_with(e); });
    return ending == endings.end() ? nullptr : *ending;
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what)
{
    throw InputError(fmt::format("{}: {}", file.string(), what));
}

MeshFile read_by_ending(const std::filesystem::path& file, const std::string& scalar)
{
    const char* known = ending_of(file.filename().string());
    if (!known)
        fail(file, fmt::format("not a name of a mesh file; they end in {}", fmt::join(endings, ", ")));
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        fail(file, std::filesystem::exists(file, error) ? "not a file" : "there is no such file");
    if (!std::ifstream(file))
        fail(file, "cannot be opened");

    const std::string_view ending = known;
    if (ending == ".obj") {
        if (!scalar.empty())
            fail(file, fmt::format("no scalar \"{}\"; it has: none", scalar));
        return read_obj_file(file);
    }
    return mesh_of(ending == ".vtu"      ? read_xml_file(file)
                   : ending == ".vtk"    ? read_legacy_file(file)
                   : ending == "xyz.bin" ? read_plot3d_file(file)
                                         : read_exodus_file(file),
                   scalar);
}

} // namespace

MeshFile read_mesh(const std::filesystem::path& file, const ReadOptions& options)
{
    MeshFile result = read_by_ending(file, options.scalar);
    const auto note = [&](std::size_t count, const char* what) {
        if (count > 0)
            result.notes.push_back(fmt::format("{} {}", count, what));
    };
    note(drop_unused_points(result.mesh), "points that no cell uses left out");
    if (options.weld)
        note(weld(result.mesh), "points joined with others of the same coordinates");
    const auto not_finite = std::count_if(result.mesh.scalars.begin(), result.mesh.scalars.end(),
                                          [](float scalar) { return !std::isfinite(scalar); });
    note(static_cast<std::size_t>(not_finite), "scalars are not finite");
    try {
        validate(result.mesh);
    } catch (const InputError& error) {
        fail(file, error.what());
    }
    return result;
}

std::span<const char* const> mesh_file_endings()
{
    return endings;
}

} // namespace visorder
