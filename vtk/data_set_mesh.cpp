#include "vtk/data_set_mesh.h"

#include "files/polygon.h"
#include "scene/error.h"
#include "vtk/cell_kind.h"
#include "vtk/scalar_array.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>
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

namespace visorder {

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

class Conversion {
public:
    Conversion(const VtkFile& file, const std::string& scalar) : file_(file), scalar_(choose_scalar(file, scalar))
    {
        result_.notes = file.notes;
    }

    MeshFile run()
    {
        check_parts();
        read_points();
        const bool solids = has_solids();
        for (const auto& part : file_.parts)
            read_cells(*part, solids);
        if (mesh().cell_count() == 0)
            fail("there are no solid or surface cells in it");
        if (scalar_)
            read_scalars();
        tell();
        return std::move(result_);
    }

private:
    Mesh& mesh() { return result_.mesh; }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw InputError(fmt::format("{}: {}", file_.path.string(), what));
    }

    void check_parts() const
    {
        const vtkIdType points = file_.parts.front()->GetNumberOfPoints();
        vtkIdType cells = 0;
        for (const auto& part : file_.parts) {
            if (!is_consistent(*part))
                fail("cannot be read: its arrays do not fit each other");
            if (part->GetNumberOfPoints() != points)
                fail("cannot be read: its blocks differ in their points");
            cells += part->GetNumberOfCells();
        }
        if (cells == 0)
            fail("there are no cells in it");
        for (const vtkIdType count : {points, cells})
            if (count > std::numeric_limits<PointId>::max())
                fail(fmt::format("{} points and {} cells are more than a mesh can have", points, cells));
    }

    void read_points()
    {
        vtkDataSet& part = *file_.parts.front();
        mesh().points.resize(static_cast<std::size_t>(part.GetNumberOfPoints()));
        for (vtkIdType i = 0; i < part.GetNumberOfPoints(); ++i)
            part.GetPoint(i, &mesh().points[static_cast<std::size_t>(i)].x);
    }

    bool has_solids() const
    {
        return std::any_of(file_.parts.begin(), file_.parts.end(), [](vtkDataSet* part) {
            for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
                if (cell_kind(part->GetCellType(cell)).use == CellKind::Use::solid)
                    return true;
            return false;
        });
    }

    void read_cells(vtkDataSet& part, bool solids)
    {
        vtkUnsignedCharArray* ghosts = part.GetCellGhostArray();
        if (ghosts && ghosts->GetNumberOfTuples() != part.GetNumberOfCells())
            fail("cannot be read: its arrays do not fit each other");
        vtkDataArray* values = scalar_ && scalar_->on_cells ? scalar_->of(part) : nullptr;
        if (values && values->GetNumberOfTuples() != part.GetNumberOfCells())
            fail(fmt::format("scalar \"{}\" has {} values for {} cells", scalar_->name, values->GetNumberOfTuples(),
                             part.GetNumberOfCells()));

        constexpr int hiding =
            vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::REFINEDCELL;
        for (vtkIdType cell = 0; cell < part.GetNumberOfCells(); ++cell, ++cell_) {
            if (ghosts && (ghosts->GetValue(cell) & hiding) != 0) {
                ++hidden_;
                continue;
            }
            const std::size_t before = mesh().cell_count();
            read_cell(part, cell, solids);
            if (values)
                cell_values_.resize(mesh().cell_count(), mesh().cell_count() > before ? magnitude(*values, cell) : 0);
        }
    }

    void read_cell(vtkDataSet& part, vtkIdType cell, bool solids)
    {
        const int type = part.GetCellType(cell);
        const CellKind kind = cell_kind(type);
        switch (kind.use) {
        case CellKind::Use::empty:
            ++hidden_;
            return;
        case CellKind::Use::lower:
            ++lower_;
            return;
        case CellKind::Use::unsupported:
            fail(fmt::format("cell {}: there is no shape for a {}", cell_, vtkCellTypes::GetClassNameFromTypeId(type)));
        case CellKind::Use::polygon:
        case CellKind::Use::strip:
            if (solids) {
                ++surface_cells_beside_solids_;
                return;
            }
            break;
        case CellKind::Use::solid:
            break;
        }

        read_corners(part, cell, kind);
        if (kind.higher_order)
            ++higher_order_;
        if (kind.use == CellKind::Use::solid)
            mesh().add(kind.shape, corners_);
        else if (kind.use == CellKind::Use::strip)
            add_strip();
        else
            add_polygon();
    }

    /// Reads the cell's corners, in the order around its faces, into corners_.
    void read_corners(vtkDataSet& part, vtkIdType cell, const CellKind& kind)
    {
        part.GetCellPoints(cell, ids_);
        const auto available = static_cast<std::size_t>(ids_->GetNumberOfIds());
        const std::size_t count = kind.corners == 0 ? available : kind.corners;
        if (available < std::max<std::size_t>(count, 3))
            fail(fmt::format("cell {}: a {} with {} points", cell_,
                             vtkCellTypes::GetClassNameFromTypeId(part.GetCellType(cell)), available));
        corners_.clear();
        for (std::size_t i = 0; i < count; ++i) {
            const vtkIdType id = ids_->GetId(static_cast<vtkIdType>(i));
            if (id < 0 || static_cast<std::size_t>(id) >= mesh().points.size())
                fail(fmt::format("cell {}: there is no point {}", cell_, id));
            const glm::dvec3& p = mesh().points[static_cast<std::size_t>(id)];
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                fail(fmt::format("cell {}: coordinates of point {} are not finite", cell_, id));
            corners_.push_back(static_cast<PointId>(id));
        }
        if (kind.grid_ordered)
            for (std::size_t i = 2; i < count; i += 4)
                std::swap(corners_[i], corners_[i + 1]);
    }

    void add_polygon()
    {
        const auto triangles = triangles_of(corners_, mesh().points);
        if (triangles.size() > 1)
            ++split_;
        for (const auto& triangle : triangles)
            mesh().add(CellShape::triangle, triangle);
    }

    void add_strip()
    {
        ++split_;
        for (std::size_t i = 0; i + 2 < corners_.size(); ++i) {
            std::array triangle{corners_[i], corners_[i + 1], corners_[i + 2]};
            if (i % 2 == 1)
                std::swap(triangle[0], triangle[1]); // every other one runs the other way round
            mesh().add(CellShape::triangle, triangle);
        }
    }

    void read_scalars()
    {
        result_.scalar = scalar_->name;
        std::vector<float>& scalars = mesh().scalars;
        scalars.resize(mesh().points.size());
        if (scalar_->on_cells) {
            average_to_points();
        } else {
            vtkDataArray* values = scalar_->of(*file_.parts.front());
            if (static_cast<std::size_t>(values->GetNumberOfTuples()) != scalars.size())
                fail(fmt::format("scalar \"{}\" has {} values for {} points", scalar_->name,
                                 values->GetNumberOfTuples(), scalars.size()));
            for (std::size_t i = 0; i < scalars.size(); ++i)
                scalars[i] = static_cast<float>(magnitude(*values, static_cast<vtkIdType>(i)));
        }
    }

    /// A point's scalar is the mean over its cells.
    void average_to_points()
    {
        std::vector<double> sums(mesh().points.size());
        std::vector<std::uint32_t> counts(mesh().points.size());
        for (CellId cell = 0; cell < mesh().cell_count(); ++cell)
            for (const PointId point : mesh().cell(cell)) {
                sums[point] += cell_values_[cell];
                ++counts[point];
            }
        for (std::size_t i = 0; i < sums.size(); ++i)
            if (counts[i] > 0)
                mesh().scalars[i] = static_cast<float>(sums[i] / counts[i]);
    }

    void tell()
    {
        const auto note = [&](std::size_t count, const char* what) {
            if (count > 0)
                result_.notes.push_back(fmt::format("{} {}", count, what));
        };
        note(higher_order_, "cells of higher order taken by their corners");
        note(split_, "polygons split into triangles");
        note(surface_cells_beside_solids_, "surface cells beside the solids left out");
        note(lower_, "vertices and lines left out");
        note(hidden_, "hidden cells left out");
        if (scalar_ && scalar_->components > 1)
            result_.notes.push_back(
                fmt::format("scalar \"{}\" is the magnitude of {} components", scalar_->name, scalar_->components));
        if (scalar_ && scalar_->on_cells)
            result_.notes.push_back(fmt::format("scalar \"{}\" averaged from cells to points", scalar_->name));
    }

    const VtkFile& file_;
    std::optional<ScalarArray> scalar_;
    MeshFile result_;
    std::vector<double> cell_values_; // one a cell of the mesh, if the scalar is of cells
    std::size_t cell_ = 0;            // the number in the file of the cell at hand
    vtkNew<vtkIdList> ids_;
    std::vector<PointId> corners_;
    std::size_t higher_order_ = 0;
    std::size_t split_ = 0;
    std::size_t surface_cells_beside_solids_ = 0;
    std::size_t lower_ = 0;
    std::size_t hidden_ = 0;
};

} // namespace

MeshFile mesh_of(const VtkFile& file, const std::string& scalar)
{
    return Conversion(file, scalar).run();
}

} // namespace visorder
