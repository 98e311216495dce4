#include "scenes/portable_numbers.h"
#include "scenes/scene_families.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace visorder::scenes {

// A ring: points p_0, p_1, ... zigzag in a plane between an inner and an outer circle, and cell i is the tetrahedron of
// p_i, p_(i+1), p_(i+2) and an apex under the middle. Outer points stand so far ahead of the inner points that they are
// joined to that all the segments p_i p_(i+1) lean the same way and, carried on inwards, pass the middle on the same
// side. So an eye that looks at the apex through the hole, or from the other side, has all the faces (apex, p_i,
// p_(i+1)) the same way round, and each cell occludes the next, around and around. The hole's cone is so wide (its
// half angle is the arctangent of 2, 63 degrees; 55 suffice) that every direction lies in that of at least one of three
// rings, one along each axis.

namespace {

constexpr double hole = 2; // distance of the segments' lines from the middle, where the plane is at height 1

constexpr double outer_to_inner = 4;
constexpr double lead = 0.2; // in turns, of an outer point before the inner point with its number

// The distance from the middle of the line between an inner point at radius 1 and an outer one that is ahead by
// `turns`.
double line_distance(double turns)
{
    const double chord_squared = 1 + outer_to_inner * outer_to_inner - 2 * outer_to_inner * cosine_of_turns(turns);
    return outer_to_inner * sine_of_turns(turns) / std::sqrt(chord_squared);
}

glm::dvec2 on_circle(double radius, double turns)
{
    return radius * glm::dvec2(cosine_of_turns(turns), sine_of_turns(turns));
}

// The points of a ring around the z axis at height 1, inner and outer in turns.
std::vector<glm::dvec2> zigzag(std::size_t teeth)
{
    const double step = 1 / static_cast<double>(teeth);
    // An outer point is joined to the inner ones with its number and with the next.
    const double inner = hole / std::min(line_distance(lead), line_distance(lead - step));
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i < teeth; ++i) {
        const double turns = static_cast<double>(i) * step;
        points.push_back(on_circle(inner, turns));
        points.push_back(on_circle(inner * outer_to_inner, turns + lead));
    }
    return points;
}

} // namespace

Mesh pinwheel_scene(std::size_t cells, std::uint64_t)
{
    const std::size_t teeth = (cells + 3) / 6;
    const std::vector<glm::dvec2> points = zigzag(teeth);
    const auto count = static_cast<PointId>(points.size());
    const double outer = std::sqrt(points[1].x * points[1].x + points[1].y * points[1].y);

    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        // The ring around z stands in the middle, and each of the others beyond both the others along its own axis.
        glm::dvec3 place(0);
        if (axis != 2)
            place[axis] = 1.5 * outer;
        const auto apex = static_cast<PointId>(mesh.points.size());
        mesh.points.push_back(place);
        for (const glm::dvec2& point : points) {
            glm::dvec3 local;
            local[axis] = 1;
            local[(axis + 1) % 3] = point.x;
            local[(axis + 2) % 3] = point.y;
            mesh.points.push_back(place + local);
        }
        for (PointId i = 0; i < count; ++i) {
            std::array<PointId, 4> cell{apex, apex + 1 + i, apex + 1 + (i + 1) % count, apex + 1 + (i + 2) % count};
            if (i % 2 == 1)
                std::swap(cell[2], cell[3]);
            mesh.add(CellShape::tetrahedron, cell);
        }
    }
    return mesh;
}

} // namespace visorder::scenes
