#include "scenes/delaunay.h"

#include "geometry/morton_curve.h"
#include "scenes/unused_points.h"
#include "visorder/box.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>

namespace visorder::scenes {

using namespace detail;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using NumberedVertex = CGAL::Triangulation_vertex_base_with_info_3<PointId, Kernel>;
using Triangulation = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<NumberedVertex, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
using Tetrahedron = std::array<PointId, 4>;

void sort_along_curve(std::vector<glm::dvec3>& points)
{
    Box bounds;
    for (const glm::dvec3& point : points)
        bounds.add(point);
    const MortonCurve curve(bounds);
    std::vector<std::pair<std::uint32_t, PointId>> keys(points.size());
    for (PointId i = 0; i < points.size(); ++i)
        keys[i] = {curve.key(points[i]), i};
    std::sort(keys.begin(), keys.end());
    std::vector<glm::dvec3> sorted(points.size());
    for (PointId i = 0; i < points.size(); ++i)
        sorted[i] = points[keys[i].second];
    points = std::move(sorted);
}

Triangulation triangulate(const std::vector<glm::dvec3>& points)
{
    std::vector<std::pair<Kernel::Point_3, PointId>> numbered;
    numbered.reserve(points.size());
    for (PointId i = 0; i < points.size(); ++i)
        numbered.emplace_back(Kernel::Point_3(points[i].x, points[i].y, points[i].z), i);
    return Triangulation(numbered.begin(), numbered.end());
}

// The same tetrahedron, not turned inside out, with its lowest vertex first and the lowest of the others second.
Tetrahedron canonical(Tetrahedron t)
{
    const auto lowest = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
    if (lowest != 0) {
        // Of the two swaps each turns it inside out.
        const std::size_t other = lowest % 3 + 1;
        std::swap(t[0], t[lowest]);
        std::swap(t[other], t[other % 3 + 1]);
    }
    std::rotate(t.begin() + 1, std::min_element(t.begin() + 1, t.end()), t.end());
    return t;
}

// Makes the cells as many tetrahedra as there are vertices for.
void name_tetrahedra(Mesh& mesh)
{
    const std::size_t count = mesh.vertices.size() / 4;
    mesh.shapes.assign(count, CellShape::tetrahedron);
    mesh.offsets.resize(count + 1);
    for (std::size_t i = 0; i <= count; ++i)
        mesh.offsets[i] = static_cast<std::uint32_t>(4 * i);
}

std::vector<Tetrahedron> finite_cells(const Triangulation& triangulation)
{
    std::vector<Tetrahedron> cells;
    cells.reserve(triangulation.number_of_finite_cells());
    for (const auto& cell : triangulation.finite_cell_handles())
        cells.push_back(canonical(
            {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()}));
    return cells;
}

// Sorts by the vertices, first to last: in linear time by the first, which few cells have in common.
std::vector<Tetrahedron> sorted(const std::vector<Tetrahedron>& cells, std::size_t point_count)
{
    std::vector<std::size_t> begin(point_count + 1, 0);
    for (const Tetrahedron& cell : cells)
        ++begin[cell[0] + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Tetrahedron> result(cells.size());
    std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
    for (const Tetrahedron& cell : cells)
        result[end[cell[0]]++] = cell;
    for (std::size_t point = 0; point < point_count; ++point)
        std::sort(result.data() + begin[point], result.data() + end[point]);
    return result;
}

} // namespace

Mesh delaunay_mesh(std::vector<glm::dvec3> points)
{
    sort_along_curve(points);
    // The triangulation takes most of the memory; it is gone before the mesh is made.
    const std::vector<Tetrahedron> cells = sorted(finite_cells(triangulate(points)), points.size());
    Mesh mesh;
    mesh.vertices.reserve(4 * cells.size());
    for (const Tetrahedron& cell : cells)
        mesh.vertices.insert(mesh.vertices.end(), cell.begin(), cell.end());
    mesh.points = std::move(points);
    drop_unused_points(mesh);
    name_tetrahedra(mesh);
    return mesh;
}

void keep_cells(Mesh& mesh, const std::function<bool(const Corners&)>& keep)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 4) {
        const PointId* const vertices = &mesh.vertices[i];
        if (!keep({mesh.points[vertices[0]], mesh.points[vertices[1]], mesh.points[vertices[2]],
                   mesh.points[vertices[3]]}))
            continue;
        std::copy_n(vertices, 4, &mesh.vertices[kept]);
        kept += 4;
    }
    mesh.vertices.resize(kept);
    drop_unused_points(mesh);
    name_tetrahedra(mesh);
}

} // namespace visorder::scenes
