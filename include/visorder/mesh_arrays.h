#pragma once

#include "visorder/mesh.h"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <variant>

namespace visorder {

/// Rows of numbers in the caller's memory, read where they stand: `stride` bytes from one row to the next, which may be
/// more than a row takes, or negative. They need not be aligned. Refers to that memory, which must stay as it is while
/// something reads it.
template <class Number>
struct Strided {
    const void* first = nullptr;
    std::size_t count = 0; ///< rows
    std::ptrdiff_t stride = sizeof(Number);

    /// Number `column` of a row.
    Number at(std::size_t row, std::size_t column = 0) const
    {
        const auto* bytes = static_cast<const std::byte*>(first) + static_cast<std::ptrdiff_t>(row) * stride;
        Number number;
        std::memcpy(&number, bytes + column * sizeof(Number), sizeof(Number));
        return number;
    }
};

/// Points, rows of x, y and z, one after another unless a stride in bytes says otherwise.
class PointArray {
public:
    PointArray() = default;
    PointArray(const float* xyz, std::size_t points, std::ptrdiff_t stride = 3 * sizeof(float))
        : rows_(Strided<float>{xyz, points, stride})
    {
    }
    PointArray(const double* xyz, std::size_t points, std::ptrdiff_t stride = 3 * sizeof(double))
        : rows_(Strided<double>{xyz, points, stride})
    {
    }

    std::size_t count() const
    {
        return std::visit([](const auto& rows) { return rows.count; }, rows_);
    }
    const std::variant<Strided<double>, Strided<float>>& rows() const { return rows_; }

private:
    std::variant<Strided<double>, Strided<float>> rows_;
};

/// One number per point, one after another unless a stride in bytes says otherwise.
class ScalarArray {
public:
    ScalarArray() = default;
    ScalarArray(const float* first, std::size_t count, std::ptrdiff_t stride = sizeof(float))
        : numbers_(Strided<float>{first, count, stride})
    {
    }
    ScalarArray(const double* first, std::size_t count, std::ptrdiff_t stride = sizeof(double))
        : numbers_(Strided<double>{first, count, stride})
    {
    }

    std::size_t count() const
    {
        return std::visit([](const auto& numbers) { return numbers.count; }, numbers_);
    }
    const std::variant<Strided<float>, Strided<double>>& numbers() const { return numbers_; }

private:
    std::variant<Strided<float>, Strided<double>> numbers_;
};

/// Integers of 32 or 64 bits, with or without a sign, one after another unless a stride in bytes says otherwise.
class IdArray {
public:
    IdArray() = default;
    template <std::integral Id>
    requires(sizeof(Id) == 4 || sizeof(Id) == 8)
        IdArray(const Id* first, std::size_t count, std::ptrdiff_t stride = sizeof(Id))
        : ids_(Strided<OfSize<Id>>{first, count, stride})
    {
    }
    template <class Id>
    IdArray(std::span<const Id> ids) : IdArray(ids.data(), ids.size())
    {
    }

    std::size_t count() const
    {
        return std::visit([](const auto& ids) { return ids.count; }, ids_);
    }
    using Ids =
        std::variant<Strided<std::int32_t>, Strided<std::uint32_t>, Strided<std::int64_t>, Strided<std::uint64_t>>;
    const Ids& ids() const { return ids_; }

private:
    // `long` and `long long` are both of 64 bits, and only one of them is std::int64_t.
    template <class Id>
    using OfSize =
        std::conditional_t<sizeof(Id) == 4, std::conditional_t<std::is_signed_v<Id>, std::int32_t, std::uint32_t>,
                           std::conditional_t<std::is_signed_v<Id>, std::int64_t, std::uint64_t>>;

    Ids ids_;
};

/// A mesh in the caller's own arrays, laid out as those of a vtkUnstructuredGrid.
struct MeshArrays {
    PointArray points;
    IdArray connectivity; ///< the vertices of one cell after another, in VTK's order
    /// Where each cell begins in `connectivity`, and its end as one more; empty where all cells are of one shape.
    IdArray offsets;
    /// A VTK cell type per cell: 5 (triangle), 10 (tetrahedron), 11 (voxel), 12 (hexahedron), 13 (wedge), 14 (pyramid).
    /// Empty: every cell is a `shape`.
    std::span<const std::uint8_t> vtk_types;
    CellShape shape = CellShape::tetrahedron; ///< of all cells, where there are no `vtk_types`
    ScalarArray scalars;                      ///< one per point, or empty; rounded to single precision
};

/// The mesh of these arrays, in the same numbering. This is the only copy that is made: a Scene takes it by std::move.
/// Throws InputError, naming the cell or point: a type that is none of these, offsets that do not ascend or do not end
/// with `connectivity`, a cell with the wrong number of vertices, a vertex that is no point, a count of scalars that is
/// not that of the points; and where `validate` does.
Mesh make_mesh(const MeshArrays& arrays);

} // namespace visorder
