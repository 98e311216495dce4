// Plot3D as its users' manual has it (Walatka et al. 1990, NASA TM-101067), in C's layout or in Fortran's, where each
// record stands between two counts of its bytes. A file does not say which of its layouts it has: its length does.
// VTK's own reader, which goes by the length too, crashes on files that fit no layout.

#include "scene/error.h"
#include "vtk/vtk_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <glm/vec3.hpp>
#include <iterator>
#include <optional>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStructuredGrid.h>
#include <vtkUnsignedCharArray.h>

namespace visorder {

namespace {

/// How many numbers a kind of file has before its points, and for each of them.
struct Content {
    std::size_t parameters;
    std::size_t reals;
};
// x, y, z
constexpr Content grid_content{0, 3};
// Mach number, angle of attack, Reynolds number, time; then density, momentum in three components, stagnation energy
constexpr Content solution_content{4, 5};

struct Layout {
    bool swapped;     ///< of the other byte order than this machine
    bool counted;     ///< begins with the number of grids
    bool fortran;     ///< has counts of bytes around records
    bool doubles;     ///< reals have 8 bytes rather than 4
    bool with_blanks; ///< ends with an integer a point, 0 where there is no point
};

/// The whole of a file, of which numbers are read at byte offsets.
class Bytes {
public:
    explicit Bytes(const std::filesystem::path& path)
    {
        std::ifstream file(path, std::ios::binary);
        bytes_.assign(std::istreambuf_iterator<char>(file), {});
    }

    std::size_t size() const { return bytes_.size(); }

    template <class T>
    T read(std::size_t at, bool swapped) const
    {
        std::array<char, sizeof(T)> raw{};
        std::memcpy(raw.data(), bytes_.data() + at, sizeof(T));
        if (swapped)
            std::reverse(raw.begin(), raw.end());
        return std::bit_cast<T>(raw);
    }

private:
    std::vector<char> bytes_;
};

/// Where things are in a file of some content and layout.
struct Places {
    glm::ivec3 size;    ///< points along each axis
    std::size_t reals;  ///< where the points' reals begin,
    std::size_t blanks; ///< their blanks,
    std::size_t end;    ///< and what comes after the file
};

/// Nothing if the file cannot have this layout, or is shorter than it must be.
std::optional<Places> places(const Bytes& bytes, const Content& content, const Layout& layout)
{
    const std::size_t count_bytes = layout.fortran ? 4 : 0; // before and after each record
    const std::size_t real_bytes = layout.doubles ? 8 : 4;
    std::size_t at = count_bytes;
    if (layout.counted) {
        if (bytes.size() < at + 4 || bytes.read<std::int32_t>(at, layout.swapped) != 1)
            return {};
        at += 4 + 2 * count_bytes;
    }
    if (bytes.size() < at + 12)
        return {};

    Places found{};
    std::size_t points = 1;
    for (int axis = 0; axis < 3; ++axis, at += 4) {
        found.size[axis] = bytes.read<std::int32_t>(at, layout.swapped);
        if (found.size[axis] < 1)
            return {};
        points *= static_cast<std::size_t>(found.size[axis]);
        if (points > bytes.size()) // before the product can overflow
            return {};
    }
    at += 2 * count_bytes;
    if (content.parameters > 0)
        at += content.parameters * real_bytes + 2 * count_bytes;
    found.reals = at;
    found.blanks = found.reals + points * content.reals * real_bytes;
    found.end = found.blanks + (layout.with_blanks ? points * 4 : 0) + count_bytes;
    if (bytes.size() < found.end)
        return {};
    return found;
}

class Plot3dFile {
public:
    /// A grid, whose layout is found out.
    explicit Plot3dFile(const std::filesystem::path& path) : bytes_(path)
    {
        for (unsigned bits = 0; bits < 32; ++bits) {
            layout_ = {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
            if (const auto found = places(bytes_, grid_content, layout_); found && found->end == bytes_.size()) {
                places_ = *found;
                return;
            }
        }
        throw InputError(
            fmt::format("{}: cannot be read: its length is that of no binary Plot3D file of one grid", path.string()));
    }

    /// The solution on a grid, of the same layout. It may be longer than it need be: some are padded to whole blocks.
    Plot3dFile(const std::filesystem::path& path, const Plot3dFile& grid) : bytes_(path), layout_(grid.layout_)
    {
        layout_.with_blanks = false;
        const auto found = places(bytes_, solution_content, layout_);
        if (!found)
            throw InputError(
                fmt::format("{}: cannot be read: it is cut short, or not laid out as its grid is", path.string()));
        places_ = *found;
        if (size() != grid.size())
            throw InputError(fmt::format("{}: its {} x {} x {} points are not the {} x {} x {} of its grid",
                                         path.string(), size().x, size().y, size().z, grid.size().x, grid.size().y,
                                         grid.size().z));
    }

    const glm::ivec3& size() const { return places_.size; }
    vtkIdType points() const { return vtkIdType{size().x} * size().y * size().z; }

    /// A point's real number i; the first of all points come first, then the second of all.
    double real(vtkIdType point, int i) const
    {
        const auto index = static_cast<std::size_t>(i * points() + point);
        return layout_.doubles ? bytes_.read<double>(places_.reals + index * 8, layout_.swapped)
                               : double{bytes_.read<float>(places_.reals + index * 4, layout_.swapped)};
    }

    /// Whether the grid has this point.
    bool is_there(vtkIdType point) const
    {
        return !layout_.with_blanks ||
               bytes_.read<std::int32_t>(places_.blanks + static_cast<std::size_t>(point) * 4, layout_.swapped) != 0;
    }

private:
    Bytes bytes_;
    Layout layout_{};
    Places places_{};
};

/// NAMEq.bin for NAMExyz.bin.
std::filesystem::path solution_of(const std::filesystem::path& grid)
{
    std::string name = grid.filename().string();
    name.replace(name.size() - std::string_view("xyz.bin").size(), 3, "q");
    return grid.parent_path() / name;
}

void set_points(vtkStructuredGrid& grid, const Plot3dFile& file)
{
    grid.SetDimensions(file.size().x, file.size().y, file.size().z);
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(file.points());
    for (vtkIdType i = 0; i < file.points(); ++i)
        points->SetPoint(i, file.real(i, 0), file.real(i, 1), file.real(i, 2));
    grid.SetPoints(points);
}

/// Hides the cells that have a point which is not there.
void hide_cells(vtkStructuredGrid& grid, const Plot3dFile& file)
{
    vtkUnsignedCharArray* marks = grid.AllocateCellGhostArray();
    const vtkNew<vtkIdList> points;
    for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
        grid.GetCellPoints(cell, points);
        for (const vtkIdType point : *points)
            if (!file.is_there(point))
                marks->SetValue(cell, vtkDataSetAttributes::HIDDENCELL);
    }
}

/// Takes components [first, first + components) of the file's reals as an array of the grid.
void add_array(vtkStructuredGrid& grid, const Plot3dFile& file, const char* name, int first, int components)
{
    const vtkNew<vtkFloatArray> array;
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(file.points());
    for (vtkIdType i = 0; i < file.points(); ++i)
        for (int k = 0; k < components; ++k)
            array->SetTypedComponent(i, k, static_cast<float>(file.real(i, first + k)));
    grid.GetPointData()->AddArray(array);
}

} // namespace

VtkFile read_plot3d_file(const std::filesystem::path& path)
{
    const Plot3dFile grid_file(path);
    const vtkNew<vtkStructuredGrid> grid;
    set_points(*grid, grid_file);
    hide_cells(*grid, grid_file);

    const std::filesystem::path solution = solution_of(path);
    if (!std::filesystem::exists(solution))
        return {path, {grid.Get()}, "", {fmt::format("no scalars: there is no {}", solution.string())}};
    const Plot3dFile solution_file(solution, grid_file);
    add_array(*grid, solution_file, "Density", 0, 1);
    add_array(*grid, solution_file, "Momentum", 1, 3);
    add_array(*grid, solution_file, "StagnationEnergy", 4, 1);
    return {path, {grid.Get()}, "Density", {}};
}

} // namespace visorder
