#include "vtk/cell_kind.h"

#include <array>
#include <vtkCellType.h>

namespace visorder::detail {

namespace {

CellKind solid(CellShape shape, bool higher_order = false, bool grid_ordered = false)
{
    constexpr std::array listed{ListedShape::polygon, ListedShape::tetrahedron, ListedShape::pyramid,
                                ListedShape::wedge, ListedShape::hexahedron};
    return {listed[static_cast<std::size_t>(shape)], static_cast<std::size_t>(vertex_count(shape)), higher_order,
            grid_ordered};
}

CellKind polygon(std::size_t corners, bool higher_order = false, bool grid_ordered = false)
{
    return {ListedShape::polygon, corners, higher_order, grid_ordered};
}

CellKind other(ListedShape shape, std::size_t corners = 0)
{
    return {shape, corners, false, false};
}

} // namespace

std::optional<CellKind> cell_kind(int vtk_type)
{
    switch (vtk_type) {
    case VTK_EMPTY_CELL:
        return other(ListedShape::empty);

    case VTK_VERTEX:
    case VTK_POLY_VERTEX:
    case VTK_LINE:
    case VTK_POLY_LINE:
    case VTK_QUADRATIC_EDGE:
    case VTK_CUBIC_LINE:
    case VTK_PARAMETRIC_CURVE:
    case VTK_HIGHER_ORDER_EDGE:
    case VTK_LAGRANGE_CURVE:
    case VTK_BEZIER_CURVE:
        return other(ListedShape::lower);

    case VTK_TRIANGLE:
        return polygon(3);
    case VTK_QUAD:
        return polygon(4);
    case VTK_PIXEL:
        return polygon(4, false, true);
    case VTK_POLYGON:
        return polygon(0);
    case VTK_TRIANGLE_STRIP:
        return other(ListedShape::strip);
    case VTK_QUADRATIC_TRIANGLE:
    case VTK_BIQUADRATIC_TRIANGLE:
    case VTK_LAGRANGE_TRIANGLE:
    case VTK_BEZIER_TRIANGLE:
        return polygon(3, true);
    case VTK_QUADRATIC_QUAD:
    case VTK_QUADRATIC_LINEAR_QUAD:
    case VTK_BIQUADRATIC_QUAD:
    case VTK_LAGRANGE_QUADRILATERAL:
    case VTK_BEZIER_QUADRILATERAL:
        return polygon(4, true);

    case VTK_TETRA:
        return solid(CellShape::tetrahedron);
    case VTK_PYRAMID:
        return solid(CellShape::pyramid);
    case VTK_WEDGE:
        return solid(CellShape::wedge);
    case VTK_HEXAHEDRON:
        return solid(CellShape::hexahedron);
    case VTK_VOXEL:
        return solid(CellShape::hexahedron, false, true);
    case VTK_QUADRATIC_TETRA:
    case VTK_LAGRANGE_TETRAHEDRON:
    case VTK_BEZIER_TETRAHEDRON:
        return solid(CellShape::tetrahedron, true);
    case VTK_QUADRATIC_PYRAMID:
    case VTK_TRIQUADRATIC_PYRAMID:
    case VTK_LAGRANGE_PYRAMID:
    case VTK_BEZIER_PYRAMID:
        return solid(CellShape::pyramid, true);
    case VTK_QUADRATIC_WEDGE:
    case VTK_QUADRATIC_LINEAR_WEDGE:
    case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
    case VTK_LAGRANGE_WEDGE:
    case VTK_BEZIER_WEDGE:
        return solid(CellShape::wedge, true);
    case VTK_QUADRATIC_HEXAHEDRON:
    case VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON:
    case VTK_TRIQUADRATIC_HEXAHEDRON:
    case VTK_LAGRANGE_HEXAHEDRON:
    case VTK_BEZIER_HEXAHEDRON:
        return solid(CellShape::hexahedron, true);

    case VTK_PENTAGONAL_PRISM:
        return other(ListedShape::pentagonal_prism, 10);
    case VTK_HEXAGONAL_PRISM:
        return other(ListedShape::hexagonal_prism, 12);
    case VTK_CONVEX_POINT_SET:
        return other(ListedShape::convex_hull);
    case VTK_POLYHEDRON:
        return other(ListedShape::polyhedron);

    default:
        return {};
    }
}

} // namespace visorder::detail
