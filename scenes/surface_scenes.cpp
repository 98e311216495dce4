#include "scenes/portable_numbers.h"
#include "scenes/scene_families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace visorder::scenes {

namespace {

glm::dvec3 unit(const glm::dvec3& v)
{
    return v / std::sqrt(glm::dot(v, v));
}

void add_triangle(Mesh& mesh, PointId a, PointId b, PointId c)
{
    mesh.add(CellShape::triangle, std::array<PointId, 3>{a, b, c});
}

// A quadrilateral as two triangles.
void add_quad(Mesh& mesh, PointId a, PointId b, PointId c, PointId d)
{
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
}

std::size_t nearest(double number)
{
    return static_cast<std::size_t>(number + 0.5);
}

// The edge of an icosahedron goes in so many parts where the whole is to have about so many triangles.
std::size_t parts_of_edge(double triangles)
{
    return std::max<std::size_t>(1, nearest(std::sqrt(triangles / 20)));
}

// The corners and faces of an icosahedron, counterclockwise from outside.
const std::array<glm::dvec3, 12>& icosahedron_corners()
{
    static const double t = (1 + std::sqrt(5.0)) / 2;
    static const std::array<glm::dvec3, 12> corners{{{-1, t, 0},
                                                     {1, t, 0},
                                                     {-1, -t, 0},
                                                     {1, -t, 0},
                                                     {0, -1, t},
                                                     {0, 1, t},
                                                     {0, -1, -t},
                                                     {0, 1, -t},
                                                     {t, 0, -1},
                                                     {t, 0, 1},
                                                     {-t, 0, -1},
                                                     {-t, 0, 1}}};
    return corners;
}

constexpr std::array<std::array<std::size_t, 3>, 20> icosahedron_faces{
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

// A sphere around the origin: the faces of an icosahedron, cut into parts^2 triangles each and carried outwards. Points
// on common edges are there twice, equal bit by bit, since their third weight is zero and sums of two commute.
void add_sphere(Mesh& mesh, double radius, std::size_t parts)
{
    const auto& corners = icosahedron_corners();
    for (const auto& [a, b, c] : icosahedron_faces) {
        const auto first = static_cast<PointId>(mesh.points.size());
        // Row i has parts + 1 - i points.
        for (std::size_t i = 0; i <= parts; ++i)
            for (std::size_t j = 0; i + j <= parts; ++j)
                mesh.points.push_back(radius *
                                      unit(static_cast<double>(parts - i - j) * corners[a] +
                                           static_cast<double>(j) * corners[b] + static_cast<double>(i) * corners[c]));
        const auto number = [&](std::size_t i, std::size_t j) {
            return first + static_cast<PointId>(i * (parts + 1) - i * (i - 1) / 2 + j);
        };
        for (std::size_t i = 0; i < parts; ++i)
            for (std::size_t j = 0; i + j < parts; ++j) {
                add_triangle(mesh, number(i, j), number(i, j + 1), number(i + 1, j));
                if (i + j + 1 < parts)
                    add_triangle(mesh, number(i, j + 1), number(i + 1, j + 1), number(i + 1, j));
            }
    }
}

glm::dvec3 random_direction(Random& random)
{
    while (true) {
        const glm::dvec3 v = 2.0 * random.in_unit_cube() - 1.0;
        const double square = glm::dot(v, v);
        if (square <= 1 && square > 0.01)
            return unit(v);
    }
}

} // namespace

Mesh sphere_scene(std::size_t cells, std::uint64_t)
{
    Mesh mesh;
    add_sphere(mesh, 1, parts_of_edge(static_cast<double>(cells)));
    weld(mesh);
    return mesh;
}

Mesh shells_scene(std::size_t cells, std::uint64_t)
{
    Mesh mesh;
    for (int shell = 5; shell > 0; --shell) {
        // Of what is left, the share of this shell's area among those to come.
        double areas = 0;
        for (int other = shell; other > 0; --other)
            areas += other * other;
        const double left = static_cast<double>(cells) - static_cast<double>(mesh.cell_count());
        add_sphere(mesh, 0.2 * shell, parts_of_edge(std::max(left, 0.0) * shell * shell / areas));
    }
    weld(mesh);
    return mesh;
}

Mesh knot_scene(std::size_t cells, std::uint64_t)
{
    // The curve winds three times through the hole of a torus while it goes twice around.
    constexpr double torus_radius = 2;
    constexpr double tube_radius = 0.4;
    constexpr double slenderness = 13; // the curve's length over the tube's girth
    const std::size_t sides =
        std::max<std::size_t>(3, nearest(std::sqrt(static_cast<double>(cells) / (2 * slenderness))));
    const std::size_t rings = (cells + sides) / (2 * sides);

    Mesh mesh;
    for (std::size_t i = 0; i < rings; ++i) {
        const double turns = static_cast<double>(i) / static_cast<double>(rings);
        const glm::dvec3 outward(cosine_of_turns(2 * turns), sine_of_turns(2 * turns), 0);
        const glm::dvec3 around(-outward.y, outward.x, 0);
        const glm::dvec3 up(0, 0, 1);
        const double cosine = cosine_of_turns(3 * turns);
        const double sine = sine_of_turns(3 * turns);
        // Of the torus; the curve lies on it, so that this stands across the curve.
        const glm::dvec3 normal = cosine * outward + sine * up;
        const glm::dvec3 middle = torus_radius * outward + normal;
        const glm::dvec3 tangent = unit(2 * (torus_radius + cosine) * around + 3.0 * (cosine * up - sine * outward));
        const glm::dvec3 across = glm::cross(tangent, normal);
        for (std::size_t j = 0; j < sides; ++j) {
            const double angle = static_cast<double>(j) / static_cast<double>(sides);
            mesh.points.push_back(middle +
                                  tube_radius * (cosine_of_turns(angle) * normal + sine_of_turns(angle) * across));
        }
    }
    const auto number = [&](std::size_t i, std::size_t j) {
        return static_cast<PointId>(i % rings * sides + j % sides);
    };
    for (std::size_t i = 0; i < rings; ++i)
        for (std::size_t j = 0; j < sides; ++j)
            add_quad(mesh, number(i, j), number(i, j + 1), number(i + 1, j + 1), number(i + 1, j));
    return mesh;
}

Mesh cards_scene(std::size_t cells, std::uint64_t seed)
{
    constexpr double height_over_width = 0.6;
    constexpr double crossings = 2; // of a card with others
    const std::size_t cards = (cells + 1) / 2;
    // Two random planar convex figures of area F and perimeter L in a unit volume meet with the probability F L / 2.
    const double half_width =
        cube_root(crossings / static_cast<double>(cards) / (height_over_width * (1 + height_over_width))) / 2;
    Random random(seed);
    Mesh mesh;
    for (std::size_t card = 0; card < cards; ++card) {
        const glm::dvec3 middle = random.in_unit_cube();
        const glm::dvec3 right = random_direction(random);
        glm::dvec3 normal;
        do
            normal = glm::cross(right, random_direction(random));
        while (glm::dot(normal, normal) < 0.01);
        const glm::dvec3 x = half_width * right;
        const glm::dvec3 y = half_width * height_over_width * glm::cross(unit(normal), right);
        const auto first = static_cast<PointId>(mesh.points.size());
        for (const glm::dvec3& corner : {-x - y, x - y, x + y, y - x})
            mesh.points.push_back(middle + corner);
        add_quad(mesh, first, first + 1, first + 2, first + 3);
    }
    return mesh;
}

} // namespace visorder::scenes
