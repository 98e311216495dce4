#include "visorder/mesh_arrays.h"

#include "visorder/error.h"

#include <array>
#include <fmt/format.h>
#include <optional>
#include <type_traits>

namespace visorder {

namespace {

constexpr std::uint8_t vtk_voxel = 11;

std::optional<CellShape> shape_of_vtk_type(std::uint8_t type)
{
    switch (type) {
    case 5:
        return CellShape::triangle;
    case 10:
        return CellShape::tetrahedron;
    case vtk_voxel:
    case 12:
        return CellShape::hexahedron;
    case 13:
        return CellShape::wedge;
    case 14:
        return CellShape::pyramid;
    default:
        return std::nullopt;
    }
}

template <class Id>
bool is_below(Id id, std::size_t end)
{
    if constexpr (std::is_signed_v<Id>)
        if (id < 0)
            return false;
    return static_cast<std::uint64_t>(id) < end;
}

// Where each cell begins in the connectivity, and the end of the last.
class CellRanges {
public:
    explicit CellRanges(const MeshArrays& arrays)
        : arrays_(arrays), per_cell_(static_cast<std::size_t>(vertex_count(arrays.shape)))
    {
        if (arrays.offsets.count() == 0) {
            if (!arrays.vtk_types.empty())
                throw InputError("cell types need offsets");
            if (arrays.connectivity.count() % per_cell_ != 0)
                throw InputError(fmt::format("{} vertices are not a whole number of cells of {}",
                                             arrays.connectivity.count(), per_cell_));
            return;
        }
        if (!arrays.vtk_types.empty() && arrays.vtk_types.size() != cell_count())
            throw InputError(
                fmt::format("{} offsets do not fit {} cell types", arrays.offsets.count(), arrays.vtk_types.size()));
        if (offset(cell_count()) != arrays.connectivity.count())
            throw InputError(fmt::format("offsets end at {}, but there are {} vertices of cells", offset(cell_count()),
                                         arrays.connectivity.count()));
    }

    std::size_t cell_count() const
    {
        return arrays_.offsets.count() > 0 ? arrays_.offsets.count() - 1 : arrays_.connectivity.count() / per_cell_;
    }
    std::size_t begin(std::size_t cell) const { return arrays_.offsets.count() > 0 ? offset(cell) : cell * per_cell_; }
    std::size_t end(std::size_t cell) const { return begin(cell + 1); }

private:
    std::size_t offset(std::size_t at) const
    {
        return std::visit(
            [&](const auto& ids) {
                const auto id = ids.at(at);
                // The last one is one beyond the vertices.
                if (!is_below(id, arrays_.connectivity.count() + 1))
                    throw InputError(fmt::format("cell {}: offset {} is beyond {} vertices of cells", at, id,
                                                 arrays_.connectivity.count()));
                return static_cast<std::size_t>(id);
            },
            arrays_.offsets.ids());
    }

    const MeshArrays& arrays_;
    std::size_t per_cell_;
};

template <class Id>
void add_cells(Mesh& mesh, const MeshArrays& arrays, const Strided<Id>& connectivity)
{
    const CellRanges ranges(arrays);
    const std::size_t cells = ranges.cell_count();
    mesh.shapes.reserve(cells);
    mesh.offsets.reserve(cells + 1);
    mesh.vertices.reserve(connectivity.count);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::size_t begin = ranges.begin(cell), end = ranges.end(cell);
        if (end < begin)
            throw CellError(cell, fmt::format("its offsets descend from {} to {}", begin, end));
        const std::uint8_t type = arrays.vtk_types.empty() ? std::uint8_t{0} : arrays.vtk_types[cell];
        const auto shape = arrays.vtk_types.empty() ? arrays.shape : shape_of_vtk_type(type);
        if (!shape)
            throw CellError(cell, fmt::format("VTK's cell type {} cannot be taken", type));
        const auto count = static_cast<std::size_t>(vertex_count(*shape));
        if (end - begin != count)
            throw CellError(cell, fmt::format("{} vertices, but a {} has {}", end - begin, name(*shape), count));
        std::array<std::uint32_t, max_cell_vertices> vertices{};
        for (std::size_t i = 0; i < count; ++i) {
            const Id id = connectivity.at(begin + i);
            if (!is_below(id, mesh.points.size()))
                throw CellError(cell, fmt::format("there is no point {}", id));
            vertices[i] = static_cast<std::uint32_t>(id);
        }
        // A voxel's vertices stand row by row, a hexahedron's around its bottom and its top.
        if (type == vtk_voxel) {
            std::swap(vertices[2], vertices[3]);
            std::swap(vertices[6], vertices[7]);
        }
        mesh.add(*shape, std::span(vertices).first(count));
    }
}

} // namespace

Mesh make_mesh(const MeshArrays& arrays)
{
    if (arrays.scalars.count() != 0 && arrays.scalars.count() != arrays.points.count())
        throw InputError(fmt::format("{} scalars do not fit {} points", arrays.scalars.count(), arrays.points.count()));
    Mesh mesh;
    std::visit(
        [&](const auto& rows) {
            mesh.points.resize(rows.count);
            for (std::size_t i = 0; i < rows.count; ++i)
                mesh.points[i] = {rows.at(i, 0), rows.at(i, 1), rows.at(i, 2)};
        },
        arrays.points.rows());
    std::visit(
        [&](const auto& numbers) {
            mesh.scalars.resize(numbers.count);
            for (std::size_t i = 0; i < numbers.count; ++i)
                mesh.scalars[i] = static_cast<float>(numbers.at(i));
        },
        arrays.scalars.numbers());
    std::visit([&](const auto& ids) { add_cells(mesh, arrays, ids); }, arrays.connectivity.ids());
    validate(mesh);
    return mesh;
}

} // namespace visorder
