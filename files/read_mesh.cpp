#include "files/read_mesh.h"

#include "files/mesh_format.h"
#include "files/obj_file.h"
#include "files/reader_process.h"
#include "files/unused_points.h"
#include "scene/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>

namespace visorder {

namespace {

constexpr std::array own_formats{MeshFormat{".obj", read_obj_file}};

std::vector<MeshFormat> all_formats()
{
    std::vector<MeshFormat> all;
#if defined(VISORDER_WITH_VTK)
    all.assign(vtk_formats().begin(), vtk_formats().end());
#endif
    all.insert(all.end(), own_formats.begin(), own_formats.end());
    return all;
}

const std::vector<MeshFormat>& formats()
{
    static const std::vector<MeshFormat> all = all_formats();
    return all;
}

/// The format that a name's ending tells, whatever the case of its letters; null for none.
const MeshFormat* format_of(std::string name)
{
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    const auto format = std::find_if(formats().begin(), formats().end(),
                                     [&](const MeshFormat& candidate) { return name.ends_with(candidate.ending); });
    return format == formats().end() ? nullptr : &*format;
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what)
{
    throw InputError(fmt::format("{}: {}", file.string(), what));
}

/// The format of a file that is there.
const MeshFormat& checked_format(const std::filesystem::path& file)
{
    const MeshFormat* format = format_of(file.filename().string());
    if (!format)
        fail(file, fmt::format("not a name of a mesh file; they end in {}", fmt::join(mesh_file_endings(), ", ")));
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        fail(file, std::filesystem::exists(file, error) ? "not a file" : "there is no such file");
    if (!std::ifstream(file))
        fail(file, "cannot be opened");
    return *format;
}

void check(const std::filesystem::path& file, const MeshFile& read)
{
    try {
        validate(read.mesh);
    } catch (const InputError& error) {
        fail(file, error.what());
    }
}

} // namespace

MeshFile read_mesh(const std::filesystem::path& file, const ReadOptions& options)
{
    const MeshFormat& format = checked_format(file);
    if (format.isolated && options.isolated) {
        MeshFile result = read_in_own_process(file, options);
        check(file, result); // it comes from a process that damage may have upset
        return result;
    }

    MeshFile result = format.read(file, options);
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
    check(file, result);
    return result;
}

std::vector<std::string> mesh_file_endings()
{
    std::vector<std::string> endings;
    for (const MeshFormat& format : formats())
        endings.emplace_back(format.ending);
    return endings;
}

} // namespace visorder
