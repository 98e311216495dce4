#include "files/read_mesh.h"

#include "files/cell_numbers.h"
#include "files/file_content.h"
#include "files/gmsh_file.h"
#include "files/medit_file.h"
#include "files/mesh_format.h"
#include "files/obj_file.h"
#include "files/off_file.h"
#include "files/plot3d_file.h"
#include "files/ply_file.h"
#include "files/reader_process.h"
#include "files/stl_file.h"
#include "files/time_step.h"
#include "scene/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>

namespace visorder {

namespace {

template <FileGrid (*Read)(const std::filesystem::path&, std::string_view)>
FileGrid read_without_time(const std::filesystem::path& path, std::string_view content, const ReadOptions& options)
{
    FileGrid grid = Read(path, content);
    choose_time_step(path, {}, options.time, grid.notes);
    return grid;
}

FileGrid read_gmsh(const std::filesystem::path& path, std::string_view content, const ReadOptions& options)
{
    return read_gmsh_file(path, content, options.time);
}

constexpr std::array own_formats{
    MeshFormat{"xyz.bin", read_without_time<read_plot3d_file>, nullptr},
    MeshFormat{".xyz", read_without_time<read_plot3d_file>, nullptr},
    MeshFormat{".x", read_without_time<read_plot3d_file>, nullptr},
    MeshFormat{".p3d", read_without_time<read_plot3d_file>, nullptr},
    MeshFormat{".mesh", read_without_time<read_medit_file>, nullptr},
    MeshFormat{".meshb", read_without_time<read_medit_binary_file>, nullptr},
    MeshFormat{".msh", read_gmsh, nullptr},
    MeshFormat{".obj", read_without_time<read_obj_file>, nullptr},
    MeshFormat{".off", read_without_time<read_off_file>, nullptr},
    MeshFormat{".ply", read_without_time<read_ply_file>, nullptr},
    MeshFormat{".stl", read_without_time<read_stl_file>, nullptr},
};
constexpr std::string_view compressed_ending = ".gz";

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

std::string in_small_letters(std::string name)
{
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return name;
}

/// The format that a name's ending tells; null for none.
const MeshFormat* format_of(const std::string& name)
{
    const auto format = std::find_if(formats().begin(), formats().end(),
                                     [&](const MeshFormat& candidate) { return name.ends_with(candidate.ending); });
    return format == formats().end() ? nullptr : &*format;
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what)
{
    throw InputError(fmt::format("{}: {}", file.string(), what));
}

/// A format, and whether the file is compressed.
struct NamedFormat {
    const MeshFormat& format;
    bool is_compressed;
};

/// The format of a file that is there.
NamedFormat checked_format(const std::filesystem::path& file)
{
    std::string name = in_small_letters(file.filename().string());
    const bool is_compressed = name.ends_with(compressed_ending);
    if (is_compressed)
        name.resize(name.size() - compressed_ending.size());
    const MeshFormat* format = format_of(name);
    if (!format)
        fail(file, fmt::format("not a name of a mesh file; they end in {}", fmt::join(mesh_file_endings(), ", ")));
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
        fail(file, std::filesystem::exists(file, error) ? "not a file" : "there is no such file");
    if (!std::ifstream(file))
        fail(file, "cannot be opened");
    if (is_compressed && !format->read_content)
        fail(file, fmt::format("files that end in {} are read only if they are not compressed", format->ending));
    return {*format, is_compressed};
}

FileGrid read_grid(const std::filesystem::path& file, const NamedFormat& named, const ReadOptions& options)
{
    if (!named.format.read_content)
        return named.format.read_file(file, options);
    const std::string content = content_of_file(file);
    return named.format.read_content(file, named.is_compressed ? decompressed(file, content) : content, options);
}

void check(const std::filesystem::path& file, const MeshFile& read)
{
    const std::size_t numbers = read.file_cells.size();
    if ((numbers != 0 && numbers != read.mesh.cell_count()) ||
        !std::is_sorted(read.file_cells.begin(), read.file_cells.end()))
        fail(file, fmt::format("{} numbers of cells do not fit {} cells", numbers, read.mesh.cell_count()));
    try {
        validate(read.mesh);
    } catch (const CellError& error) {
        fail(file, cell_numbers(read).message(error));
    } catch (const InputError& error) {
        fail(file, error.what());
    }
}

} // namespace

MeshFile read_mesh(const std::filesystem::path& file, const ReadOptions& options)
{
    const NamedFormat named = checked_format(file);
    if (named.format.isolated && options.isolated) {
        MeshFile result = read_in_own_process(file, options);
        check(file, result); // it comes from a process that damage may have upset
        return result;
    }

    MeshFile result = mesh_of(read_grid(file, named, options), options);
    if (options.weld && options.weld_tolerance > 0)
        if (const std::size_t joined = weld(result.mesh, options.weld_tolerance); joined > 0)
            result.notes.push_back(fmt::format("{} points joined with others near them", joined));
    const auto not_finite = std::count_if(result.mesh.scalars.begin(), result.mesh.scalars.end(),
                                          [](float scalar) { return !std::isfinite(scalar); });
    if (not_finite > 0)
        result.notes.push_back(fmt::format("{} scalars are missing: they are not finite", not_finite));
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
