#include "visorder/read_mesh.h"

#include "files/cell_numbers.h"
#include "files/file_content.h"
#include "files/gmsh_file.h"
#include "files/mapped_file.h"
#include "files/medit_file.h"
#include "files/mesh_format.h"
#include "files/obj_file.h"
#include "files/off_file.h"
#include "files/plot3d_file.h"
#include "files/ply_file.h"
#include "files/reader_process.h"
#include "files/stl_file.h"
#include "files/time_step.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace visorder {

using namespace detail;

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
    if (is_compressed && format->names_others)
        fail(file, fmt::format("files that end in {} are read only if they are not compressed", format->ending));
    return {*format, is_compressed};
}

FileGrid read_grid(const std::filesystem::path& file, const NamedFormat& named, const ReadOptions& options)
{
    if (!named.format.read_content)
        return named.format.read_file(file, options);
    const MappedFile mapped(file);
    if (named.is_compressed)
        return named.format.read_content(file, decompressed(file, mapped.content()), options);
    return named.format.read_content(file, mapped.content(), options);
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

/// A file that is there as long as this is.
class TemporaryFile {
public:
    TemporaryFile(const std::string& ending, std::string_view content)
    {
        std::string name = (std::filesystem::temp_directory_path() / ("visorder-XXXXXX" + ending)).string();
        const int descriptor = mkstemps(name.data(), static_cast<int>(ending.size()));
        if (descriptor < 0)
            throw std::system_error(errno, std::generic_category(), name);
        close(descriptor);
        path_ = name;
        std::ofstream(path_, std::ios::binary) << content;
    }
    ~TemporaryFile()
    {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Reads a compressed file of a format whose reader opens files itself.
MeshFile read_decompressed_copy(const std::filesystem::path& file, const MeshFormat& format, const ReadOptions& options)
{
    const TemporaryFile copy(format.ending, decompressed(file, content_of_file(file)));
    try {
        return read_mesh(copy.path(), options);
    } catch (const InputError& error) {
        std::string what = error.what();
        const std::string name = copy.path().string();
        for (std::size_t at = what.find(name); at != std::string::npos; at = what.find(name))
            what.replace(at, name.size(), file.string());
        throw InputError(what);
    }
}

/// What is done alike for all formats.
MeshFile finished(const std::filesystem::path& file, FileGrid&& grid, const ReadOptions& options)
{
    MeshFile result = mesh_of(std::move(grid), options);
    const auto not_finite = std::count_if(result.mesh.scalars.begin(), result.mesh.scalars.end(),
                                          [](float scalar) { return !std::isfinite(scalar); });
    if (not_finite > 0)
        result.notes.push_back(fmt::format("{} scalars are missing: they are not finite", not_finite));
    check(file, result);
    return result;
}

/// The bytes of the files that an index of files may name: those that begin with its name or lie in a folder that does,
/// as programs write them.
std::uint64_t bytes_of_named_files(const std::filesystem::path& index)
{
    namespace fs = std::filesystem;
    std::uint64_t bytes = 0;
    std::error_code error;
    const auto add = [&](const fs::directory_entry& entry) {
        if (entry.is_regular_file(error))
            bytes += entry.file_size(error);
    };
    const std::string stem = index.stem().string();
    const fs::path folder = index.has_parent_path() ? index.parent_path() : fs::path(".");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        if (!entry.path().filename().string().starts_with(stem))
            continue;
        add(entry);
        if (entry.is_directory(error))
            for (const fs::directory_entry& inner : fs::recursive_directory_iterator(entry.path(), error))
                add(inner);
    }
    return bytes;
}

/// Runs a reader, of which damaged files may ask for any amount of memory.
template <class Read>
MeshFile within_memory(const std::filesystem::path& file, const Read& read)
{
    try {
        return read();
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    }
    fail(file, "cannot be read: it asks for more memory than there is");
}

} // namespace

MeshFile read_mesh(const std::filesystem::path& file, const ReadOptions& options)
{
    const NamedFormat named = checked_format(file);
    return within_memory(file, [&] {
        if (named.is_compressed && !named.format.read_content)
            return read_decompressed_copy(file, named.format, options);
        if (named.format.isolated && options.isolated) {
            MeshFile result = named.format.names_others
                                  ? read_in_own_process(file, options, limits_for(bytes_of_named_files(file)))
                                  : read_in_own_process(file, options);
            check(file, result); // it comes from a process that damage may have upset
            return result;
        }
        return finished(file, read_grid(file, named, options), options);
    });
}

MeshFile read_mesh_content(const std::filesystem::path& name, std::string_view content, const ReadOptions& options)
{
    const MeshFormat* format = format_of(in_small_letters(name.filename().string()));
    if (!format || !format->read_content)
        fail(name, "not a name of a mesh file that can be read from memory");
    return within_memory(name, [&] { return finished(name, format->read_content(name, content, options), options); });
}

std::vector<std::string> mesh_file_endings()
{
    std::vector<std::string> endings;
    for (const MeshFormat& format : formats())
        endings.emplace_back(format.ending);
    return endings;
}

} // namespace visorder
