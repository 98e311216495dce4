#include "vtk/vtk_cell_center.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>
#include <vtkCamera.h>
#include <vtkCellCenterDepthSort.h>
#include <vtkCellType.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

namespace visorder::detail {

namespace {

int vtk_type(CellShape shape)
{
    switch (shape) {
    case CellShape::triangle:
        return VTK_TRIANGLE;
    case CellShape::tetrahedron:
        return VTK_TETRA;
    case CellShape::pyramid:
        return VTK_PYRAMID;
    case CellShape::wedge:
        return VTK_WEDGE;
    case CellShape::hexahedron:
        return VTK_HEXAHEDRON;
    }
    return VTK_EMPTY_CELL;
}

void fill(vtkUnstructuredGrid& grid, const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    const vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        points->SetPoint(scene.caller_points()[i], &mesh.points[i].x);
    grid.SetPoints(points);

    std::vector<CellId> inner_cells(mesh.cell_count());
    for (CellId i = 0; i < mesh.cell_count(); ++i)
        inner_cells[scene.caller_cells()[i]] = i;

    grid.AllocateExact(static_cast<vtkIdType>(mesh.cell_count()), static_cast<vtkIdType>(mesh.vertices.size()));
    std::vector<vtkIdType> vertices;
    for (const CellId inner : inner_cells) {
        vertices.clear();
        for (const PointId point : mesh.cell(inner))
            vertices.push_back(scene.caller_points()[point]);
        grid.InsertNextCell(vtk_type(mesh.shapes[inner]), static_cast<vtkIdType>(vertices.size()), vertices.data());
    }
}

bool is_finite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double largest(const glm::dvec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The unit vector along v, whose squared length may be beyond a double; zero if v shows no direction.
glm::dvec3 direction_of(const glm::dvec3& v)
{
    if (!is_finite(v) || largest(v) == 0)
        return glm::dvec3(0);
    return glm::normalize(v / largest(v));
}

/// Where the camera of a view looks: a unit vector.
glm::dvec3 projection_direction(const View& view, const glm::dvec3& middle)
{
    if (view.eye.w == 0)
        return -direction_of(glm::dvec3(view.eye));

    // What a perspective matrix makes clip space's w grows along the view and nowhere else.
    const glm::dmat4& matrix = view.world_to_clip;
    if (const glm::dvec3 forward = direction_of({matrix[0][3], matrix[1][3], matrix[2][3]}); forward != glm::dvec3(0))
        return forward;
    // middle - eye / w, times |w|, which may be too small to divide by
    const double w = std::abs(view.eye.w);
    if (const glm::dvec3 to_middle = direction_of(middle * w - glm::dvec3(view.eye) * (view.eye.w < 0 ? -1.0 : 1.0));
        to_middle != glm::dvec3(0))
        return to_middle;
    return {0, 0, -1}; // from the middle any direction is as good; this one is VTK's own
}

} // namespace

struct VtkCellCenter::Vtk {
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkCamera> camera;
    vtkNew<vtkCellCenterDepthSort> sort;
};

VtkCellCenter::VtkCellCenter(const Scene& scene)
    : vtk_(std::make_unique<Vtk>()),
      middle_(scene.bounds().min * 0.5 + scene.bounds().max * 0.5),
      radius_(glm::length(scene.bounds().max * 0.5 - scene.bounds().min * 0.5)),
      returned_(scene.cell_count())
{
    fill(*vtk_->grid, scene);
    vtk_->sort->SetInput(vtk_->grid);
    vtk_->sort->SetCamera(vtk_->camera);
    vtk_->sort->SetDirectionToBackToFront();
}

VtkCellCenter::~VtkCellCenter() = default;

void VtkCellCenter::sort(const View& view, Order& order)
{
    validate(view);
    const glm::dvec3 direction = projection_direction(view, middle_);
    glm::dvec3 position = glm::dvec3(view.eye) / view.eye.w;
    // The sort reads a direction alone, as the difference of two points, in single precision. An eye too far away for
    // that gives way to a point before the scene.
    if (view.eye.w == 0 || !(largest(position) < std::numeric_limits<float>::max() / 2))
        position = middle_ - direction * radius_;
    const glm::dvec3 focal_point = position + direction * std::max(largest(position), 1.0);
    vtk_->camera->SetParallelProjection(view.eye.w == 0);
    vtk_->camera->SetPosition(position.x, position.y, position.z);
    vtk_->camera->SetFocalPoint(focal_point.x, focal_point.y, focal_point.z);

    order.back_to_front.clear();
    order.layer_begin.clear();
    order.cycles.clear();
    std::fill(returned_.begin(), returned_.end(), false);
    vtk_->sort->InitTraversal();
    while (const vtkIdTypeArray* cells = vtk_->sort->GetNextCells())
        for (vtkIdType i = 0; i < cells->GetNumberOfValues(); ++i) {
            const auto cell = static_cast<std::size_t>(cells->GetValue(i));
            if (cell >= returned_.size() || returned_[cell])
                throw std::runtime_error(fmt::format("vtkCellCenterDepthSort returned cell {} twice", cell));
            returned_[cell] = true;
            order.back_to_front.push_back(static_cast<CellId>(cell));
        }
    if (order.back_to_front.size() != returned_.size())
        throw std::runtime_error(fmt::format("vtkCellCenterDepthSort returned {} of {} cells",
                                             order.back_to_front.size(), returned_.size()));
}

std::size_t VtkCellCenter::bytes() const
{
    return std::size_t{vtk_->grid->GetActualMemorySize()} * 1024;
}

} // namespace visorder::detail
