#pragma once

#include "optics/medium_integral.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "visorder/scene.h"
#include "visorder/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <vector>

// Rays, the stretches of them inside cells, and light along them, by the plainest means.
namespace visorder::tests::naive {

using namespace detail;

using Number = long double;
using Vector = glm::vec<3, Number>;

struct Ray {
    Vector origin;
    Vector direction; // unit
    Number first;     // where it begins, as a distance from the origin
};

inline Ray ray_through(const View& view, double px, double py)
{
    const auto point = [&](double z) {
        const glm::dvec4 clip{2 * px / view.size.x - 1, 2 * py / view.size.y - 1, z, 1};
        const glm::dvec4 world = glm::inverse(view.world_to_clip) * clip;
        return Vector(glm::dvec3(world) / world.w);
    };
    const Vector near = point(-1), far = point(1);
    if (view.eye.w == 0)
        return {near, glm::normalize(far - near), -std::numeric_limits<Number>::infinity()};
    const Vector eye(view.eye);
    return {eye, glm::normalize(far - eye), 0};
}

struct Stretch {
    Number begin, end; // distances from the ray's origin
    Number length() const { return end > begin ? end - begin : 0; }
};

/// Cuts off what is outside the plane through three points, on the side of a fourth.
inline void clip(Stretch& stretch, const Ray& ray, const Vector& a, const Vector& b, const Vector& c,
                 const Vector& inside)
{
    Vector normal = glm::cross(b - a, c - a);
    if (glm::dot(normal, inside - a) > 0)
        normal = -normal;
    const Number rate = glm::dot(normal, ray.direction);
    const Number from = glm::dot(normal, a - ray.origin);
    if (rate > 0)
        stretch.end = std::min(stretch.end, from / rate);
    else if (rate < 0)
        stretch.begin = std::max(stretch.begin, from / rate);
    else if (from < 0)
        stretch.end = stretch.begin;
}

inline std::array<Vector, 4> corners(const Mesh& mesh, CellId cell)
{
    std::array<Vector, 4> result;
    for (std::size_t i = 0; i < 4; ++i)
        result[i] = Vector(mesh.points[mesh.cell(cell)[i]]);
    return result;
}

inline Stretch inside_cell(const Ray& ray, const std::array<Vector, 4>& p)
{
    Stretch stretch{ray.first, std::numeric_limits<Number>::infinity()};
    for (std::size_t i = 0; i < 4; ++i)
        clip(stretch, ray, p[(i + 1) % 4], p[(i + 2) % 4], p[(i + 3) % 4], p[i]);
    return stretch;
}

/// Inside the planes of all boundary faces: inside a convex mesh.
inline Stretch inside_hull(const Ray& ray, const Scene& scene)
{
    Stretch stretch{ray.first, std::numeric_limits<Number>::infinity()};
    for (const CellFace& face : scene.boundary().faces) {
        const auto p = corners(scene.mesh(), face.cell);
        const auto f = face_vertices(CellShape::tetrahedron, static_cast<int>(face.face));
        clip(stretch, ray, p[f[0]], p[f[1]], p[f[2]], p[std::size_t{6} - f[0] - f[1] - f[2]]);
    }
    return stretch;
}

inline Number volume(const std::array<Vector, 4>& p)
{
    return glm::dot(p[1] - p[0], glm::cross(p[2] - p[0], p[3] - p[0])) / 6;
}

/// The scalar where a ray is at a distance, by volumes.
inline Number scalar_at(const Ray& ray, Number distance, const std::array<Vector, 4>& p, const std::array<float, 4>& s)
{
    const Vector x = ray.origin + distance * ray.direction;
    Number sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        auto q = p;
        q[i] = x;
        sum += volume(q) / volume(p) * static_cast<Number>(s[i]);
    }
    return sum;
}

/// The medium at a scalar. Not made for scalars at jumps.
inline MediumPoint medium_at(const std::vector<MediumPoint>& medium, double scalar)
{
    if (scalar <= medium.front().scalar)
        return medium.front();
    for (std::size_t i = 1; i < medium.size(); ++i)
        if (scalar < medium[i].scalar) {
            const double t = (scalar - medium[i - 1].scalar) / (medium[i].scalar - medium[i - 1].scalar);
            return {scalar, (1 - t) * medium[i - 1].extinction + t * medium[i].extinction,
                    (1 - t) * medium[i - 1].colour + t * medium[i].colour};
        }
    return medium.back();
}

/// Light along a length on which `medium_along(t)` is the medium at t in [0, 1]: each of many steps as if the medium
/// were constant on it.
template <class MediumAlong>
void pass_in_steps(Light& light, Number length, int steps, const MediumAlong& medium_along)
{
    for (int i = 0; i < steps; ++i) {
        const MediumPoint m = medium_along((i + 0.5) / steps);
        const double hidden = -std::expm1(-m.extinction * static_cast<double>(length) / steps);
        light.colour += light.transmittance * hidden * m.colour;
        light.transmittance *= 1 - hidden;
    }
}

/// The light of one ray through a scene, its cells tried one by one. Not made for rays along faces.
inline Light cast(const Scene& scene, const std::vector<MediumPoint>& medium, const Ray& ray, int steps_per_cell)
{
    const Mesh& mesh = scene.mesh();
    std::vector<std::pair<Stretch, CellId>> passed;
    for (CellId cell = 0; cell < scene.cell_count(); ++cell)
        if (const auto p = corners(mesh, cell); volume(p) != 0)
            if (const Stretch stretch = inside_cell(ray, p); stretch.length() > 1e-12)
                passed.emplace_back(stretch, cell);
    std::sort(passed.begin(), passed.end(), [](const auto& a, const auto& b) { return a.first.begin < b.first.begin; });
    Light light;
    for (const auto& [stretch, cell] : passed) {
        const auto p = corners(mesh, cell);
        std::array<float, 4> s{};
        for (std::size_t i = 0; i < 4; ++i)
            s[i] = mesh.scalars[mesh.cell(cell)[i]];
        const double first = static_cast<double>(scalar_at(ray, stretch.begin, p, s));
        const double last = static_cast<double>(scalar_at(ray, stretch.end, p, s));
        pass_in_steps(light, stretch.length(), steps_per_cell,
                      [&](double t) { return medium_at(medium, (1 - t) * first + t * last); });
    }
    return light;
}

} // namespace visorder::tests::naive
