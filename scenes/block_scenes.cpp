#include "scenes/delaunay.h"
#include "scenes/lattice.h"
#include "scenes/portable_numbers.h"
#include "scenes/scene_families.h"

#include <algorithm>
#include <glm/vec3.hpp>
#include <vector>

namespace visorder::scenes {

namespace {

// Random points on and in a box of unit size: on its edges, sides and inside equally dense, and its corners.
std::vector<glm::dvec3> points_of_box(const glm::dvec3& low, std::size_t inside, Random& random)
{
    const double density = cube_root(static_cast<double>(std::max<std::size_t>(inside, 1)));
    const auto on_edge = static_cast<std::size_t>(density + 0.5);
    const auto on_side = static_cast<std::size_t>(density * density + 0.5);
    std::vector<glm::dvec3> points;
    const auto add = [&](std::size_t count, const auto& constrain) {
        for (std::size_t i = 0; i < count; ++i) {
            glm::dvec3 point = low + random.in_unit_cube();
            constrain(point);
            points.push_back(point);
        }
    };
    add(inside, [](glm::dvec3&) {});
    for (int axis = 0; axis < 3; ++axis) {
        const int second = (axis + 1) % 3;
        for (const double end : {0.0, 1.0}) {
            add(on_side, [&](glm::dvec3& point) { point[axis] = low[axis] + end; });
            for (const double second_end : {0.0, 1.0})
                add(on_edge, [&](glm::dvec3& point) {
                    point[axis] = low[axis] + end;
                    point[second] = low[second] + second_end;
                });
        }
    }
    for (int corner = 0; corner < 8; ++corner)
        points.push_back(low + glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2));
    return points;
}

void append(Mesh& mesh, const Mesh& other)
{
    const auto first_point = static_cast<PointId>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    std::vector<PointId> vertices;
    for (CellId cell = 0; cell < other.cell_count(); ++cell) {
        vertices.clear();
        for (const PointId vertex : other.cell(cell))
            vertices.push_back(first_point + vertex);
        mesh.add(other.shapes[cell], vertices);
    }
}

} // namespace

Mesh contact_scene(std::size_t cells, std::uint64_t seed)
{
    const std::size_t inside = count_for(cells / 2, [](double points) {
        // 6.768 a point inside, and what the points of the hull add, measured.
        const double density = cube_root(std::max(points, 1.0));
        return 6.768 * points + 20.3 * density * density + 22 * density;
    });
    Random random(seed);
    Mesh mesh = delaunay_mesh(points_of_box({0, 0, 0}, inside, random));
    append(mesh, delaunay_mesh(points_of_box({1, 0.25, -0.125}, inside, random)));
    return mesh;
}

Mesh grid_scene(std::size_t cells, std::uint64_t)
{
    LatticeSize size = lattice_size((cells + 3) / 6, {1, 1, 1}, {1, 1, 1});
    double spacing = 1;
    while (spacing * static_cast<double>(std::max({size[0], size[1], size[2]})) > 1)
        spacing /= 2;
    for (std::size_t& count : size)
        ++count;
    Mesh mesh;
    for (std::size_t k = 0; k < size[2]; ++k)
        for (std::size_t j = 0; j < size[1]; ++j)
            for (std::size_t i = 0; i < size[0]; ++i)
                mesh.points.push_back(spacing * glm::dvec3(i, j, k));
    add_hexahedra(mesh, size, false);
    return mesh;
}

} // namespace visorder::scenes
