#include "projection/near_cell.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <utility>

namespace visorder {

namespace {

struct PixelBox {
    glm::dvec2 low, high;
};

PixelBox image_of(const Screen& screen)
{
    return {-glm::dvec2(screen.centre()), glm::dvec2(screen.size() - screen.centre())};
}

// Pixels that the cell may cover: around its points where all are before the eye, else all of the image.
PixelBox box_of(const Screen& screen, const std::array<glm::dvec3, 4>& points)
{
    const PixelBox image = image_of(screen);
    PixelBox box{image.high, image.low};
    for (const glm::dvec3& point : points) {
        const ScreenPoint p = screen.seen(point);
        if (!(p.w > 0) || !std::isfinite(p.x) || !std::isfinite(p.y))
            return image;
        box.low = glm::min(box.low, glm::dvec2(p.x, p.y));
        box.high = glm::max(box.high, glm::dvec2(p.x, p.y));
    }
    return box;
}

// A half space, normal . x <= height, of a face and the tetrahedron's fourth point on its inner side.
struct HalfSpace {
    glm::dvec3 normal;
    double height;
    double inside; // how far the fourth point is from the face, below 0
};

// The normal's size, and what is lost to rounding, depend on the face alone.
HalfSpace half_space(const std::array<glm::dvec3, 4>& points, std::size_t opposite)
{
    std::array<glm::dvec3, 3> face;
    std::copy_if(points.begin(), points.end(), face.begin(),
                 [&](const glm::dvec3& p) { return &p != &points[opposite]; });
    // From the point nearest to the origin, so that a face with a point there passes exactly through it.
    for (std::size_t k = 1; k < 3; ++k)
        if (glm::dot(face[k], face[k]) < glm::dot(face[0], face[0]))
            std::swap(face[0], face[k]);
    glm::dvec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
    normal /= glm::length(normal);
    double inside = glm::dot(normal, points[opposite] - face[0]);
    if (inside > 0) {
        normal = -normal;
        inside = -inside;
    }
    return {normal, glm::dot(normal, face[0]), inside};
}

// Faces and scalars, given how positions that the points are in follow from a pixel and a depth d: they are
// origins (x, y, 1) + d rays (x, y, 1).
std::optional<NearCell> made(const Screen& screen, const std::array<glm::dvec3, 4>& points,
                             const std::array<double, 4>& values, const glm::dmat3& origins, const glm::dmat3& rays,
                             const PixelBox& box)
{
    NearCell cell{};
    glm::dvec3 gradient(0);
    for (std::size_t i = 0; i < 4; ++i) {
        const HalfSpace face = half_space(points, i);
        if (!(face.inside < 0) || !std::isfinite(face.inside))
            return std::nullopt;
        gradient += face.normal * (values[i] / face.inside);
        cell.offsets[i] = face.normal * origins;
        cell.offsets[i].z -= face.height;
        cell.slopes[i] = face.normal * rays;
    }
    cell.scalar_offset = gradient * origins;
    cell.scalar_offset.z += values[0] - glm::dot(gradient, points[0]);
    cell.scalar_slope = gradient * rays;
    const PixelBox image = image_of(screen);
    cell.low = glm::ivec2(glm::clamp(glm::floor(box.low), image.low, image.high));
    cell.high = glm::ivec2(glm::clamp(glm::ceil(box.high), image.low, image.high));
    if (cell.low.x >= cell.high.x || cell.low.y >= cell.high.y)
        return std::nullopt;
    return cell;
}

void set_range(NearCell& cell, const std::array<float, 4>& scalars)
{
    cell.scalar_range = {*std::min_element(scalars.begin(), scalars.end()),
                         *std::max_element(scalars.begin(), scalars.end())};
}

constexpr double infinitely_far = -1e300;

} // namespace

std::optional<NearCell> near_cell(const Screen& screen, const std::array<glm::dvec3, 4>& points,
                                  const std::array<float, 4>& scalars)
{
    std::array<glm::dvec3, 4> from;
    for (std::size_t i = 0; i < 4; ++i)
        from[i] = points[i] - screen.reference();
    std::optional<NearCell> cell = made(screen, from, {scalars[0], scalars[1], scalars[2], scalars[3]},
                                        screen.origins(), screen.rays(), box_of(screen, points));
    if (cell) {
        cell->inverse_distance = 0;
        cell->first_depth = screen.perspective() ? 0 : infinitely_far;
        set_range(*cell, scalars);
    }
    return cell;
}

std::optional<NearCell> near_cell_on_screen(const Screen& screen, const std::array<glm::dvec3, 4>& at,
                                            const std::array<float, 4>& scalars)
{
    std::array<double, 4> values{};
    PixelBox box{glm::dvec2(at[0].x, at[0].y), glm::dvec2(at[0].x, at[0].y)};
    for (std::size_t i = 0; i < 4; ++i) {
        values[i] = static_cast<double>(scalars[i]) * (1 - at[i].z * screen.inverse_distance());
        box.low = glm::min(box.low, glm::dvec2(at[i].x, at[i].y));
        box.high = glm::max(box.high, glm::dvec2(at[i].x, at[i].y));
    }
    const glm::dmat3 places(1, 0, 0, 0, 1, 0, 0, 0, 0);
    const glm::dmat3 along(0, 0, 0, 0, 0, 0, 0, 0, 1);
    std::optional<NearCell> cell = made(screen, at, values, places, along, box);
    if (cell) {
        cell->inverse_distance = screen.inverse_distance();
        cell->first_depth = infinitely_far;
        set_range(*cell, scalars);
    }
    return cell;
}

} // namespace visorder
