#pragma once

#include "scene/face_loop.h"
#include "visorder/scene.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Mpzf.h>
#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

// The definitions, decided exactly and slowly, by other means than the library's.
namespace visorder::tests::brute_force {

using namespace detail;

using Number = CGAL::Mpzf; // exact for sums and products of doubles
using Vector3 = std::array<Number, 3>;
using Vector4 = std::array<Number, 4>;

inline Vector3 exact(const glm::dvec3& v)
{
    return {Number(v.x), Number(v.y), Number(v.z)};
}

inline Vector3 cross(const Vector3& a, const Vector3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Number dot(const Vector3& a, const Vector3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector3 negated(const Vector3& v)
{
    return {-v[0], -v[1], -v[2]};
}

template <class Vector>
Vector sum(const Vector& a, const Vector& b)
{
    Vector s;
    std::transform(a.begin(), a.end(), b.begin(), s.begin(), [](const auto& x, const auto& y) { return x + y; });
    return s;
}

template <class Vector>
bool all_zero(const Vector& v)
{
    return std::all_of(v.begin(), v.end(), [](const auto& x) { return x == 0; });
}

// What "a obstructs b" means: a ray from the eye passes through the interior of a and later through that of b. The
// points beyond the inner ones of a, seen from the eye, are the interior of the polyhedron that a's vertices and the
// rays through them (or the one direction of sight) span, so a obstructs b if and only if that polyhedron and b have
// inner points in common: if no plane separates them weakly. If any does, one does that holds three of all the vertices
// and rays.
//
// With T = std::int64_t, for points and eyes with integer coordinates of at most 2^13.
template <class T>
class Obstruction {
public:
    Obstruction(const std::vector<std::array<T, 3>>& a, const std::vector<std::array<T, 3>>& b,
                const std::array<T, 4>& eye)
    {
        for (const auto& x : a) {
            beyond_.push_back({x[0], x[1], x[2], T(1)});
            if (eye[3] != T(0))
                beyond_.push_back({x[0] - eye[0], x[1] - eye[1], x[2] - eye[2], T(0)});
        }
        if (eye[3] == T(0))
            beyond_.push_back({-eye[0], -eye[1], -eye[2], T(0)});
        for (const auto& x : b)
            back_.push_back({x[0], x[1], x[2], T(1)});
    }

    // For solid cells and an eye with w = 1 or 0.
    bool holds() const
    {
        std::vector<std::array<T, 4>> all = beyond_;
        all.insert(all.end(), back_.begin(), back_.end());
        for (std::size_t i = 0; i < all.size(); ++i)
            for (std::size_t j = i + 1; j < all.size(); ++j)
                for (std::size_t k = j + 1; k < all.size(); ++k)
                    if (separates(normal(all[i], all[j], all[k])))
                        return false;
        return true;
    }

private:
    using Row = std::array<T, 4>;

    static Row normal(const Row& a, const Row& b, const Row& c)
    {
        Row n;
        for (std::size_t skip = 0; skip < 4; ++skip) {
            const std::size_t x = skip == 0 ? 1 : 0, y = skip <= 1 ? 2 : 1, z = skip <= 2 ? 3 : 2;
            const T minor = a[x] * (b[y] * c[z] - b[z] * c[y]) - a[y] * (b[x] * c[z] - b[z] * c[x]) +
                            a[z] * (b[x] * c[y] - b[y] * c[x]);
            n[skip] = skip % 2 == 0 ? minor : -minor;
        }
        return n;
    }

    bool separates(const Row& n) const
    {
        if (all_zero(n))
            return false;
        int side = 0; // of what lies beyond a
        const auto sign = [&](const Row& x) {
            const T value = n[0] * x[0] + n[1] * x[1] + n[2] * x[2] + n[3] * x[3];
            return value > T(0) ? 1 : value < T(0) ? -1 : 0;
        };
        for (const Row& x : beyond_) {
            const int s = sign(x);
            if (s * side < 0)
                return false;
            side = s != 0 ? s : side;
        }
        return std::none_of(back_.begin(), back_.end(), [&](const Row& x) { return sign(x) * side > 0; });
    }

    std::vector<Row> beyond_;
    std::vector<Row> back_;
};

template <class T>
std::vector<std::array<T, 3>> vertices(const Scene& scene, CellId cell)
{
    std::vector<std::array<T, 3>> result;
    for (PointId v : scene.mesh().cell(cell)) {
        const glm::dvec3& p = scene.mesh().points[v];
        const std::array<T, 3> x{T(p.x), T(p.y), T(p.z)};
        if (std::find(result.begin(), result.end(), x) == result.end())
            result.push_back(x);
    }
    return result;
}

/// Whether inner cell a obstructs b; both solid.
template <class T>
bool obstructs(const Scene& scene, CellId a, CellId b, const glm::dvec4& eye)
{
    return Obstruction<T>(vertices<T>(scene, a), vertices<T>(scene, b), {T(eye.x), T(eye.y), T(eye.z), T(eye.w)})
        .holds();
}

/// Whether two convex solids have inner points in common, from the vertices of their intersection: it has an interior
/// if the mean of these lies strictly behind every face of both.
inline bool interiors_overlap(const Scene& scene, CellId a, CellId b)
{
    using Rational = CGAL::Exact_rational;
    struct HalfSpace {
        Vector4 plane; // <= 0 inside
    };
    std::vector<HalfSpace> half_spaces;
    const Mesh& mesh = scene.mesh();
    for (CellId cell : {a, b})
        for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
            const FaceLoop loop = face_loop(mesh, cell, face);
            Vector3 n{};
            Vector3 origin{};
            for (int i = 0; i + 2 < loop.count && all_zero(n); ++i) {
                origin = exact(mesh.points[loop.vertices[static_cast<std::size_t>(i)]]);
                const Vector3 p = exact(mesh.points[loop.vertices[static_cast<std::size_t>(i) + 1]]);
                const Vector3 q = exact(mesh.points[loop.vertices[static_cast<std::size_t>(i) + 2]]);
                n = cross(sum(p, negated(origin)), sum(q, negated(origin)));
            }
            if (all_zero(n))
                continue;
            Number offset = -dot(n, origin);
            for (PointId v : mesh.cell(cell))
                if (dot(n, exact(mesh.points[v])) + offset > 0) {
                    n = negated(n);
                    offset = -offset;
                    break;
                }
            half_spaces.push_back({{n[0], n[1], n[2], offset}});
        }
    const auto normal = [](const HalfSpace& h) { return Vector3{h.plane[0], h.plane[1], h.plane[2]}; };
    std::array<Rational, 3> mean{};
    int corners = 0;
    for (std::size_t i = 0; i < half_spaces.size(); ++i)
        for (std::size_t j = i + 1; j < half_spaces.size(); ++j)
            for (std::size_t k = j + 1; k < half_spaces.size(); ++k) {
                const Vector3 jk = cross(normal(half_spaces[j]), normal(half_spaces[k]));
                const Vector3 ki = cross(normal(half_spaces[k]), normal(half_spaces[i]));
                const Vector3 ij = cross(normal(half_spaces[i]), normal(half_spaces[j]));
                Number w = dot(normal(half_spaces[i]), jk);
                if (w == 0)
                    continue;
                Vector3 x;
                for (std::size_t c = 0; c < 3; ++c)
                    x[c] = -(half_spaces[i].plane[3] * jk[c] + half_spaces[j].plane[3] * ki[c] +
                             half_spaces[k].plane[3] * ij[c]);
                if (w < 0) {
                    x = negated(x);
                    w = -w;
                }
                if (std::any_of(half_spaces.begin(), half_spaces.end(),
                                [&](const HalfSpace& h) { return dot(normal(h), x) + h.plane[3] * w > 0; }))
                    continue;
                for (std::size_t c = 0; c < 3; ++c)
                    mean[c] += Rational(x[c]) / Rational(w);
                ++corners;
            }
    return corners > 0 && std::all_of(half_spaces.begin(), half_spaces.end(), [&](const HalfSpace& h) {
               Rational value = Rational(h.plane[3]) * corners;
               for (std::size_t c = 0; c < 3; ++c)
                   value += Rational(h.plane[c]) * mean[c];
               return value < 0;
           });
}

} // namespace visorder::tests::brute_force
