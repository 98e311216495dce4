#include "vtk/data_set_grid.h"

#include "visorder/error.h"
#include "vtk/array_union.h"
#include "vtk/cell_kind.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vtkCellArray.h>
#include <vtkCellTypes.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

namespace visorder::detail {

namespace {

/// Reading the cells of a data set with inconsistent arrays would read beyond them.
bool is_consistent(vtkDataSet& part)
{
    if (auto* grid = vtkUnstructuredGrid::SafeDownCast(&part)) {
        return !grid->GetCells() ||
               (grid->GetCells()->IsValid() && grid->GetCellTypesArray() &&
                grid->GetCellTypesArray()->GetNumberOfTuples() == grid->GetCells()->GetNumberOfCells());
    }
    if (auto* surface = vtkPolyData::SafeDownCast(&part)) {
        return surface->GetVerts()->IsValid() && surface->GetLines()->IsValid() && surface->GetPolys()->IsValid() &&
               surface->GetStrips()->IsValid();
    }
    if (auto* grid = vtkRectilinearGrid::SafeDownCast(&part)) {
        const int* size = grid->GetDimensions();
        return grid->GetXCoordinates()->GetNumberOfTuples() == size[0] &&
               grid->GetYCoordinates()->GetNumberOfTuples() == size[1] &&
               grid->GetZCoordinates()->GetNumberOfTuples() == size[2];
    }
    return true;
}

class PartsReading {
public:
    explicit PartsReading(const VtkFile& file) : file_(file)
    {
        grid_.path = file.path;
        grid_.notes = file.notes;
    }

    FileGrid run()
    {
        check_parts();
        for (const VtkFile::Part& part : file_.parts) {
            if (!part.block.empty())
                grid_.blocks.push_back({part.block, grid_.cells.size()});
            if (!file_.shared_points || grid_.points.empty())
                read_points(*part.data);
            read_cells(*part.data);
        }
        grid_.arrays = union_of_arrays(file_, false);
        for (FileArray& array : union_of_arrays(file_, true))
            grid_.arrays.push_back(std::move(array));
        return std::move(grid_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError(fmt::format("{}: {}", file_.path.string(), what));
    }

    void check_parts() const
    {
        std::uint64_t points = 0;
        std::uint64_t cells = 0;
        for (const VtkFile::Part& part : file_.parts) {
            if (!is_consistent(*part.data))
                fail("cannot be read: its arrays do not fit each other");
            if (file_.shared_points && part.data->GetNumberOfPoints() != file_.parts.front().data->GetNumberOfPoints())
                fail("cannot be read: its blocks differ in their points");
            points += static_cast<std::uint64_t>(part.data->GetNumberOfPoints());
            cells += static_cast<std::uint64_t>(part.data->GetNumberOfCells());
        }
        if (cells == 0)
            fail("there are no cells in it");
        if (std::max(points, cells) > std::numeric_limits<PointId>::max())
            fail(fmt::format("{} points and {} cells are more than a mesh can have", points, cells));
    }

    void read_points(vtkDataSet& part)
    {
        grid_.pieces.push_back(grid_.points.size());
        first_point_ = static_cast<std::int64_t>(grid_.points.size());
        grid_.points.resize(grid_.points.size() + static_cast<std::size_t>(part.GetNumberOfPoints()));
        for (vtkIdType i = 0; i < part.GetNumberOfPoints(); ++i)
            part.GetPoint(i, &grid_.points[static_cast<std::size_t>(first_point_ + i)].x);
    }

    void read_cells(vtkDataSet& part)
    {
        vtkUnsignedCharArray* cell_marks = part.GetCellGhostArray();
        vtkUnsignedCharArray* point_marks = part.GetPointGhostArray();
        if ((cell_marks && cell_marks->GetNumberOfTuples() != part.GetNumberOfCells()) ||
            (point_marks && point_marks->GetNumberOfTuples() != part.GetNumberOfPoints()))
            fail("cannot be read: its arrays do not fit each other");

        constexpr int hiding =
            vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL;
        for (vtkIdType cell = 0; cell < part.GetNumberOfCells(); ++cell) {
            const bool hidden = cell_marks && (cell_marks->GetValue(cell) & hiding) != 0;
            read_cell(part, cell, hidden);
            if (point_marks && touches_hidden_point(part, *point_marks))
                grid_.cells.back().hidden = true;
        }
    }

    bool touches_hidden_point(vtkDataSet& part, vtkUnsignedCharArray& marks) const
    {
        return std::any_of(ids_->begin(), ids_->end(), [&](vtkIdType id) {
            return id >= 0 && id < part.GetNumberOfPoints() &&
                   (marks.GetValue(id) & vtkDataSetAttributes::HIDDENPOINT) != 0;
        });
    }

    /// Lists the cell, and leaves its points in ids_.
    void read_cell(vtkDataSet& part, vtkIdType cell, bool hidden)
    {
        const int type = part.GetCellType(cell);
        const std::optional<CellKind> kind = cell_kind(type);
        ids_->Reset();
        corners_.clear();
        if (hidden || !kind || kind->shape == ListedShape::empty || kind->shape == ListedShape::lower) {
            if (!kind && !hidden)
                fail(fmt::format("cell {}: there is no shape for a {}", grid_.cells.size(),
                                 vtkCellTypes::GetClassNameFromTypeId(type)));
            grid_.add({kind ? kind->shape : ListedShape::empty, false, hidden}, {});
            return;
        }

        part.GetCellPoints(cell, ids_);
        if (kind->shape == ListedShape::polyhedron)
            read_faces(part, cell);
        else
            read_corners(type, *kind);
        grid_.add({kind->shape, kind->higher_order, false}, corners_);
    }

    /// Reads the cell's corners, in the order around its faces, into corners_.
    void read_corners(int type, const CellKind& kind)
    {
        const auto available = static_cast<std::size_t>(ids_->GetNumberOfIds());
        const std::size_t count = kind.corners == 0 ? available : kind.corners;
        if (available < std::max<std::size_t>(count, 3))
            fail(fmt::format("cell {}: a {} with {} points", grid_.cells.size(),
                             vtkCellTypes::GetClassNameFromTypeId(type), available));
        for (std::size_t i = 0; i < count; ++i)
            corners_.push_back(point(ids_->GetId(static_cast<vtkIdType>(i))));
        if (kind.grid_ordered)
            for (std::size_t i = 2; i < count; i += 4)
                std::swap(corners_[i], corners_[i + 1]);
    }

    /// Reads a polyhedron's faces as `ListedShape::polyhedron` has them.
    void read_faces(vtkDataSet& part, vtkIdType cell)
    {
        auto* grid = vtkUnstructuredGrid::SafeDownCast(&part);
        vtkIdTypeArray* locations = grid ? grid->GetFaceLocations() : nullptr;
        vtkIdTypeArray* stream = grid ? grid->GetFaces() : nullptr;
        const bool located = locations && stream && cell < locations->GetNumberOfValues();
        vtkIdType at = located ? locations->GetValue(cell) : -1;
        if (at < 0)
            fail(fmt::format("cell {}: a polyhedron without faces", grid_.cells.size()));
        const auto next = [&] {
            if (at >= stream->GetNumberOfValues())
                fail(fmt::format("cell {}: a polyhedron whose faces are cut short", grid_.cells.size()));
            return stream->GetValue(at++);
        };
        corners_.push_back(next());
        for (vtkIdType faces = corners_.back(); faces > 0; --faces) {
            corners_.push_back(next());
            for (vtkIdType left = corners_.back(); left > 0; --left)
                corners_.push_back(point(next()));
        }
    }

    /// The number among all points of one that has this number in its part.
    std::int64_t point(vtkIdType id) const
    {
        const auto in_part = static_cast<std::int64_t>(grid_.points.size()) - first_point_;
        if (id < 0 || id >= in_part)
            fail(fmt::format("cell {}: there is no point {}", grid_.cells.size(), id));
        return first_point_ + id;
    }

    const VtkFile& file_;
    FileGrid grid_;
    std::int64_t first_point_ = 0; // of the piece at hand
    vtkNew<vtkIdList> ids_;
    std::vector<std::int64_t> corners_;
};

} // namespace

FileGrid grid_of(const VtkFile& file)
{
    return PartsReading(file).run();
}

} // namespace visorder::detail
