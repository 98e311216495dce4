#include "scene/circumspheres.h"

#include "geometry/exact_predicates.h"
#include "visorder/error.h"
#include "visorder/scene.h"

#include <CGAL/Gmpq.h>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

// Only tetrahedra are asked exactly; a mixed-element cell without volume shows as one without a sphere.
bool is_flat(const Mesh& mesh, CellId cell)
{
    const auto v = mesh.cell(cell);
    return mesh.shapes[cell] == CellShape::tetrahedron &&
           side_of_plane(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]) == Sign::zero;
}

// Below this ratio of determinant to edge lengths, extended precision no longer gives a centre good to a double.
constexpr long double ill_conditioned = 1e-6L;

// The centre relative to the first vertex c solves 2 (v_i - v_0) . c = |v_i - v_0|^2 (Cramer's rule).
template <class Number>
void solve(const Number (&e)[3][3], Number (&numerator)[3], Number& determinant)
{
    Number square[3];
    for (int i = 0; i < 3; ++i)
        square[i] = e[i][0] * e[i][0] + e[i][1] * e[i][1] + e[i][2] * e[i][2];
    Number cross[3][3]; // of edges i+1 and i+2
    for (int i = 0; i < 3; ++i) {
        const auto& p = e[(i + 1) % 3];
        const auto& q = e[(i + 2) % 3];
        for (int k = 0; k < 3; ++k)
            cross[i][k] = p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
    }
    determinant = e[0][0] * cross[0][0] + e[0][1] * cross[0][1] + e[0][2] * cross[0][2];
    for (int k = 0; k < 3; ++k)
        numerator[k] = square[0] * cross[0][k] + square[1] * cross[1][k] + square[2] * cross[2][k];
}

glm::dvec3 exact_centre(const glm::dvec3& v0, const glm::dvec3& v1, const glm::dvec3& v2, const glm::dvec3& v3)
{
    using Rational = CGAL::Gmpq;
    const glm::dvec3* v[3] = {&v1, &v2, &v3};
    Rational e[3][3], numerator[3], determinant;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            e[i][k] = Rational((*v[i])[k]) - Rational(v0[k]);
    solve(e, numerator, determinant);
    glm::dvec3 centre;
    for (int k = 0; k < 3; ++k)
        centre[k] = CGAL::to_double(numerator[k] / (Rational(2) * determinant));
    return centre;
}

// Of a near-flat cell the centre is far off and its determinant nearly cancels: hence extended precision.
glm::dvec3 centre_of(const glm::dvec3& v0, const glm::dvec3& v1, const glm::dvec3& v2, const glm::dvec3& v3)
{
    const glm::dvec3* v[3] = {&v1, &v2, &v3};
    long double e[3][3], numerator[3], determinant;
    long double lengths = 1;
    for (int i = 0; i < 3; ++i) {
        long double square = 0;
        for (int k = 0; k < 3; ++k) {
            e[i][k] = static_cast<long double>((*v[i])[k]) - v0[k];
            square += e[i][k] * e[i][k];
        }
        lengths *= std::sqrt(square);
    }
    solve(e, numerator, determinant);
    if (!(std::abs(determinant) > ill_conditioned * lengths))
        return exact_centre(v0, v1, v2, v3);
    glm::dvec3 centre;
    for (int k = 0; k < 3; ++k)
        centre[k] = static_cast<double>(numerator[k] / (2 * determinant));
    return centre;
}

// Four vertices that span a mixed-element cell: for each shape the first one and three neighbours that see it as a
// corner.
std::array<int, 4> corner_of(CellShape shape)
{
    switch (shape) {
    case CellShape::pyramid:
        return {0, 1, 3, 4};
    case CellShape::wedge:
        return {0, 1, 2, 3};
    case CellShape::hexahedron:
        return {0, 1, 3, 4};
    default:
        return {0, 1, 2, 3};
    }
}

// A sphere relative to the cell's first vertex, which lies on it.
struct Sphere {
    glm::dvec3 centre;
    bool exists;
};

Sphere circumsphere(const Mesh& mesh, CellId cell)
{
    const auto v = mesh.cell(cell);
    const auto corner = corner_of(mesh.shapes[cell]);
    const auto point = [&](int i) -> const glm::dvec3& { return mesh.points[v[static_cast<std::size_t>(i)]]; };
    const glm::dvec3& first = point(0);
    const glm::dvec3 centre = centre_of(first, point(corner[1]), point(corner[2]), point(corner[3]));
    const double square = glm::dot(centre, centre);
    for (int i = 4; i < static_cast<int>(v.size()); ++i) {
        const glm::dvec3 to_centre = point(i) - first - centre;
        // Vertices of real mixed-element cells carry the rounding of their coordinates: this asks whether a sphere is
        // meant.
        if (!(std::abs(glm::dot(to_centre, to_centre) - square) <= 1e-9 * square))
            return {centre, false};
    }
    return {centre, std::isfinite(square)};
}

} // namespace

Circumspheres derive_circumspheres(const Scene& scene)
{
    if (scene.is_surface())
        throw InputError("triangles have no circumspheres");
    const Mesh& mesh = scene.mesh();
    Circumspheres result;
    result.origin = scene.bounds().middle();
    result.centre.resize(scene.cell_count());
    result.constant.resize(scene.cell_count());
    std::atomic<std::size_t> stand_ins{0};
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, scene.cell_count(), 4096), [&](const auto& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell) {
            const auto v = mesh.cell(cell);
            if (!is_flat(mesh, cell)) {
                const Sphere sphere = circumsphere(mesh, cell);
                if (sphere.exists) {
                    const glm::dvec3 first = mesh.points[v[0]] - result.origin;
                    result.centre[cell] = first + sphere.centre;
                    // |first + centre|^2 - |centre|^2, without that difference of squares.
                    result.constant[cell] = glm::dot(first, first) + 2 * glm::dot(first, sphere.centre);
                    continue;
                }
            }
            ++stand_ins;
            const double weight = 1 / static_cast<double>(v.size());
            glm::dvec3 mean(0);
            double mean_square = 0;
            for (PointId p : v) {
                const glm::dvec3 x = mesh.points[p] - result.origin;
                mean += x * weight;
                mean_square += glm::dot(x, x) * weight;
            }
            result.centre[cell] = mean;
            result.constant[cell] = 2 * glm::dot(mean, mean) - mean_square;
        }
    });
    result.stand_ins = stand_ins;
    return result;
}

} // namespace visorder::detail
