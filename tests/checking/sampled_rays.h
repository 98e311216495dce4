#pragma once

#include "visorder/scene.h"

#include <CGAL/Exact_rational.h>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

// What rays show, one after another in rational arithmetic: dumber than any other truth, and never wrong about what it
// sees. What no ray of it passes, it does not know.
namespace visorder::tests::sampled_rays {

using namespace detail;

using Rational = CGAL::Exact_rational;
using Vector = std::array<Rational, 3>;

inline Vector vector_of(const glm::dvec3& v)
{
    return {Rational(v.x), Rational(v.y), Rational(v.z)};
}

inline Rational dot(const Vector& a, const Vector& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector difference(const Vector& a, const Vector& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Vector cross(const Vector& a, const Vector& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Points q + s d, s >= from, or all s: a ray or, from an eye at infinity, a line.
struct Ray {
    Vector q, d;
    std::optional<Rational> from;
};

/// Through q, which is not the eye; w is not negative.
inline Ray ray_through(const glm::dvec4& eye, const Vector& q)
{
    const Vector e = vector_of(glm::dvec3(eye));
    const Rational w(eye.w);
    Ray ray{q, {q[0] * w - e[0], q[1] * w - e[1], q[2] * w - e[2]}, {}};
    if (w != 0)
        ray.from = Rational(-1) / w;
    return ray;
}

/// The convex hull of a solid's vertices: n (x - p) <= 0 for every plane (n, p) through three of them that has the rest
/// on one side.
using Planes = std::vector<std::pair<Vector, Vector>>;

inline Planes planes_of(const std::vector<Vector>& vertices)
{
    Planes planes;
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (std::size_t j = i + 1; j < vertices.size(); ++j)
            for (std::size_t k = j + 1; k < vertices.size(); ++k) {
                const Vector n = cross(difference(vertices[j], vertices[i]), difference(vertices[k], vertices[i]));
                bool above = false, below = false;
                for (const Vector& v : vertices) {
                    const Rational height = dot(n, difference(v, vertices[i]));
                    above = above || height > 0;
                    below = below || height < 0;
                }
                if (above != below)
                    planes.emplace_back(above ? Vector{-n[0], -n[1], -n[2]} : n, vertices[i]);
            }
    return planes;
}

/// The parameters of the ray's points in the interior of a solid, if there are any.
inline std::optional<std::pair<Rational, Rational>> stretch_in_solid(const Planes& planes, const Ray& ray)
{
    std::optional<Rational> enter = ray.from, leave;
    for (const auto& [n, p] : planes) {
        const Rational height = dot(n, difference(ray.q, p)), slope = dot(n, ray.d);
        if (slope == 0) {
            if (height >= 0)
                return std::nullopt;
            continue;
        }
        const Rational at = -height / slope;
        if (slope < 0 && (!enter || at > *enter))
            enter = at;
        if (slope > 0 && (!leave || at < *leave))
            leave = at;
    }
    if (!enter || !leave || *enter >= *leave)
        return std::nullopt;
    return std::pair(*enter, *leave);
}

/// Where the ray passes through a triangle's interior; none for a ray in its plane.
inline std::optional<std::pair<Rational, Rational>> point_in_triangle(const std::vector<Vector>& v, const Ray& ray)
{
    if (v.size() < 3)
        return std::nullopt;
    const Vector n = cross(difference(v[1], v[0]), difference(v[2], v[0]));
    const Rational slope = dot(n, ray.d);
    if (slope == 0)
        return std::nullopt;
    const Rational at = -dot(n, difference(ray.q, v[0])) / slope;
    if (ray.from && at <= *ray.from)
        return std::nullopt;
    const Vector x{ray.q[0] + at * ray.d[0], ray.q[1] + at * ray.d[1], ray.q[2] + at * ray.d[2]};
    for (std::size_t i = 0; i < 3; ++i)
        if (dot(n, cross(difference(v[(i + 1) % 3], v[i]), difference(x, v[i]))) <= 0)
            return std::nullopt;
    return std::pair(at, at);
}

inline std::vector<Vector> vertices_of(const Scene& scene, CellId cell)
{
    std::vector<Vector> vertices;
    for (PointId v : scene.mesh().cell(cell))
        vertices.push_back(vector_of(scene.mesh().points[v]));
    return vertices;
}

/// Whether a occludes b, and b occludes a, on any of the rays through a grid of `count` to the power of three points of
/// the box that holds both, which are off all simple fractions of it.
inline std::pair<bool, bool> occlusions(const Scene& scene, CellId a, CellId b, const glm::dvec4& eye, int count)
{
    const auto of_a = vertices_of(scene, a), of_b = vertices_of(scene, b);
    Vector low = of_a[0], high = of_a[0];
    for (const auto* vertices : {&of_a, &of_b})
        for (const Vector& v : *vertices)
            for (std::size_t c = 0; c < 3; ++c) {
                low[c] = std::min(low[c], v[c]);
                high[c] = std::max(high[c], v[c]);
            }
    const Planes planes_of_a = planes_of(of_a), planes_of_b = planes_of(of_b);
    std::pair<bool, bool> found{false, false};
    for (int i = 0; i < count * count * count; ++i) {
        Vector q;
        const int places[] = {i % count, i / count % count, i / count / count};
        for (std::size_t c = 0; c < 3; ++c)
            q[c] = low[c] + (high[c] - low[c]) * Rational(1009 * places[c] + 501 + 7 * static_cast<int>(c)) /
                                Rational(1009 * count);
        const Ray ray = ray_through(eye, q);
        const auto in_a = scene.is_surface() ? point_in_triangle(of_a, ray) : stretch_in_solid(planes_of_a, ray);
        if (!in_a)
            continue;
        const auto in_b = scene.is_surface() ? point_in_triangle(of_b, ray) : stretch_in_solid(planes_of_b, ray);
        if (!in_b)
            continue;
        found.first = found.first || in_a->first < in_b->second;
        found.second = found.second || in_b->first < in_a->second;
    }
    return found;
}

} // namespace visorder::tests::sampled_rays
