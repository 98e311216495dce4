#include "scenes/delaunay.h"
#include "scenes/lattice.h"
#include "scenes/portable_numbers.h"
#include "scenes/scene_families.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace visorder::scenes {

namespace {

// Cells of the Delaunay tetrahedralisation of this many random points in a cube. 6.768 a point is the mean far from a
// boundary (24 pi^2 / 35); the rest, which the hull takes away, is measured.
double cells_of_random_points(double points)
{
    const double side = cube_root(points);
    return 6.768 * points - 1.9 * side * side - 15 * side - 40;
}

std::vector<glm::dvec3> random_points(std::size_t count, std::uint64_t seed)
{
    Random random(seed);
    std::vector<glm::dvec3> points(count);
    std::generate(points.begin(), points.end(), [&] { return random.in_unit_cube(); });
    return points;
}

// sin x cos y + sin y cos z + sin z cos x, where a turn is 1.
double gyroid(const glm::dvec3& turns)
{
    return sine_of_turns(turns.x) * cosine_of_turns(turns.y) + sine_of_turns(turns.y) * cosine_of_turns(turns.z) +
           sine_of_turns(turns.z) * cosine_of_turns(turns.x);
}

} // namespace

Mesh delaunay_scene(std::size_t cells, std::uint64_t seed)
{
    return delaunay_mesh(random_points(count_for(cells, cells_of_random_points), seed));
}

Mesh carved_scene(std::size_t cells, std::uint64_t seed)
{
    constexpr double periods = 2;
    Mesh mesh = delaunay_scene(2 * cells, seed);
    keep_cells(mesh, [](const Corners& corners) {
        return gyroid(periods / 4 * (corners[0] + corners[1] + corners[2] + corners[3])) > 0;
    });
    return mesh;
}

Mesh sliver_scene(std::size_t cells, std::uint64_t seed)
{
    constexpr double jitter = 1e-9;
    // Measured, as above.
    const std::size_t points_wanted = count_for(cells, [](double points) {
        const double side = cube_root(points);
        return 7.05 * points - 2.3 * side * side - 24 * side;
    });
    const LatticeSize size = lattice_size(points_wanted, {1, 1, 1}, {2, 2, 2});
    const double spacing = 1 / static_cast<double>(std::max({size[0], size[1], size[2]}));
    Random random(seed);
    std::vector<glm::dvec3> points;
    points.reserve(size[0] * size[1] * size[2]);
    for (std::size_t k = 0; k < size[2]; ++k)
        for (std::size_t j = 0; j < size[1]; ++j)
            for (std::size_t i = 0; i < size[0]; ++i)
                points.push_back(spacing * (glm::dvec3(i, j, k) + jitter * (2.0 * random.in_unit_cube() - 1.0)));
    return delaunay_mesh(std::move(points));
}

Mesh offset_scene(std::size_t cells, std::uint64_t seed)
{
    std::vector<glm::dvec3> points = random_points(count_for(cells, cells_of_random_points), seed);
    for (glm::dvec3& point : points)
        point += glm::dvec3(1e7, -2e7, 3e7);
    return delaunay_mesh(std::move(points));
}

Mesh cavity_scene(std::size_t cells, std::uint64_t seed)
{
    constexpr double island_radius = 0.2;
    constexpr double shell_radius = 0.3;
    // The share of the cube that both bodies take, less what they lose near the two spheres, where cells reach across:
    // measured.
    const std::size_t count = count_for(cells, [](double points) {
        const double spacing = 1 / cube_root(points);
        return (0.92 - 0.9 * spacing - 3 * spacing * spacing) * cells_of_random_points(points);
    });
    Mesh mesh = delaunay_mesh(random_points(count, seed));
    keep_cells(mesh, [&](const Corners& corners) {
        const auto distance = [](const glm::dvec3& corner) { return glm::distance(corner, glm::dvec3(0.5)); };
        return std::ranges::all_of(corners, [&](const glm::dvec3& c) { return distance(c) < island_radius; }) ||
               std::ranges::all_of(corners, [&](const glm::dvec3& c) { return distance(c) > shell_radius; });
    });
    return mesh;
}

} // namespace visorder::scenes
