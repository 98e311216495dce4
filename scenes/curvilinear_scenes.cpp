#include "scenes/lattice.h"
#include "scenes/portable_numbers.h"
#include "scenes/scene_families.h"

#include <algorithm>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace visorder::scenes {

// Why the grids of this file have no cycles: each is a plane grid of rectangles and isosceles trapezoids, extruded
// straight up. Give every point of the plane grid the height of a convex function of its distance from the body (plus
// one of the way downstream): the four corners of each piece stay in one plane, and the surface is convex, also when
// carried on across the body; rounding moves points by far less than it bends. So the pieces lie like the facets of a
// convex body seen from above, and so do the extruded cells, one dimension up. Cells that do are acyclic from every eye
// (Edelsbrunner 1990, An acyclicity theorem for cell complexes in d dimensions). Pulling the points down a little more,
// the lowest number the most, turns each hexahedron into tetrahedra and keeps that.

namespace {

// `steps` + 1 places from `first` to `last`, whose steps grow by a constant factor, the last `growth` times the first.
std::vector<double> graded(double first, double last, std::size_t steps, double growth)
{
    const auto power = [](double base, std::size_t exponent) {
        double result = 1;
        for (; exponent > 0; --exponent)
            result *= base;
        return result;
    };
    // Bisected, until the middle is one of the ends.
    double low = 1;
    double high = growth;
    while (steps > 1) {
        const double middle = (low + high) / 2;
        if (middle <= low || middle >= high)
            break;
        (power(middle, steps - 1) < growth ? low : high) = middle;
    }
    std::vector<double> places{0};
    double step = 1;
    for (std::size_t i = 0; i < steps; ++i, step *= low)
        places.push_back(places.back() + step);
    const double scale = (last - first) / places.back();
    for (double& place : places)
        place = first + scale * place;
    places.back() = last;
    return places;
}

} // namespace

Mesh fin_scene(std::size_t cells, std::uint64_t)
{
    constexpr double fin_radius = 1;
    constexpr double outer_radius = 8;
    constexpr double chord = 8;
    constexpr double height = 8;
    const LatticeSize size = lattice_size((cells + 3) / 6, {39, 31, 31}, {4, 1, 1});

    // Along the C: up one side from behind, half round the leading edge, and back down the other side.
    const std::size_t straight = std::max<std::size_t>(1, size[0] / 4);
    const std::size_t round = size[0] - 2 * straight;
    const std::vector<double> downstream = graded(0, chord, straight, 6);
    const auto along = [&](std::size_t i, double radius) -> glm::dvec2 {
        if (i <= straight)
            return {downstream[straight - i], -radius};
        if (i >= straight + round)
            return {downstream[i - straight - round], radius};
        const double turns = 0.75 - 0.5 * static_cast<double>(i - straight) / static_cast<double>(round);
        return radius * glm::dvec2(cosine_of_turns(turns), sine_of_turns(turns));
    };

    Mesh mesh;
    const std::vector<double> radii = graded(fin_radius, outer_radius, size[1], 40);
    for (const double z : graded(0, height, size[2], 10))
        for (const double radius : radii)
            for (std::size_t i = 0; i <= size[0]; ++i)
                mesh.points.emplace_back(along(i, radius), z);
    add_hexahedra(mesh, {size[0] + 1, size[1] + 1, size[2] + 1}, false);
    return mesh;
}

Mesh post_scene(std::size_t cells, std::uint64_t)
{
    constexpr double post_radius = 1;
    constexpr double outer_radius = 10;
    constexpr double height = 6;
    const LatticeSize size = lattice_size((cells + 3) / 6, {38, 76, 38}, {1, 3, 1});

    Mesh mesh;
    const std::vector<double> radii = graded(post_radius, outer_radius, size[0], 40);
    for (const double z : graded(0, height, size[2], 5))
        for (std::size_t j = 0; j < size[1]; ++j) {
            const double turns = static_cast<double>(j) / static_cast<double>(size[1]);
            const glm::dvec2 direction(cosine_of_turns(turns), sine_of_turns(turns));
            for (const double radius : radii)
                mesh.points.emplace_back(radius * direction, z);
        }
    add_hexahedra(mesh, {size[0] + 1, size[1], size[2] + 1}, true);
    return mesh;
}

} // namespace visorder::scenes
