#include "scene/face_planes.h"

#include "scene/error.h"
#include "scene/face_loop.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace visorder {

namespace {

using Range = oneapi::tbb::blocked_range<CellId>;

// Single precision stands for a normal whose components are known to 2^-28 of the largest. With that, unit coordinates
// and an eye scaled to a largest component near 1, the error of the filter's value n.e + d w is at most
//   sum |e_i| (2^-25 + 2^-28 [n] + 2^-23.9 [e, rounded twice] + 2^-22 [four roundings of the sum])  <  2^-21 sum |e_i|,
//   |w| (2^-22.8 [d: |d| <= 3, n's error times |point| <= 1 in three components] + 12 2^-24 [sum] + 3 2^-24 [w])
//                                                                                                   <  2^-19 |w|,
// and what underflows is below 2^-140.
constexpr double normal_accuracy = 0x1p-28;

float error_bound(const glm::dvec3& e, double w)
{
    const double bound = 0x1p-21 * (std::abs(e.x) + std::abs(e.y) + std::abs(e.z)) + 0x1p-19 * std::abs(w) + 0x1p-120;
    return std::nextafter(static_cast<float>(bound), std::numeric_limits<float>::infinity());
}

struct Plane {
    float x = 0, y = 0, z = 0, offset = 0;
};

Plane operator-(const Plane& p)
{
    return {-p.x, -p.y, -p.z, -p.offset};
}

// The plane through three points, from the side that sees them counterclockwise; zeros if it is not known well enough.
Plane plane_through(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const FacePlanes& planes)
{
    const glm::dvec3 p = (b - a) * planes.scale, q = (c - a) * planes.scale;
    const glm::dvec3 n(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x);
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    const double permanent =
        std::max({std::abs(p.y * q.z) + std::abs(p.z * q.y), std::abs(p.z * q.x) + std::abs(p.x * q.z),
                  std::abs(p.x * q.y) + std::abs(p.y * q.x)});
    // Each of the two products of a component carries three roundings and their difference one more.
    constexpr double u = std::numeric_limits<double>::epsilon() / 2;
    const double error = 5 * u * permanent + std::numeric_limits<double>::min();
    if (!(error <= normal_accuracy / 2 * largest))
        return {};
    const glm::dvec3 unit = n / largest;
    const double offset = -glm::dot(unit, (a - planes.origin) * planes.scale);
    return {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z),
            static_cast<float>(offset)};
}

// The outward plane of a face of a solid cell, from its vertices in ascending order, so that both its cells compute the
// same numbers.
Plane face_plane(const Mesh& mesh, const FaceLoop& loop, int orientation, const FacePlanes& planes)
{
    std::array<int, max_face_vertices> order{0, 1, 2, 3};
    std::sort(order.begin(), order.begin() + loop.count,
              [&](int i, int j) { return loop.begin()[i] < loop.begin()[j]; });
    const auto through = [&](int i, int j, int k) {
        const Plane plane = plane_through(mesh.points[loop.begin()[i]], mesh.points[loop.begin()[j]],
                                          mesh.points[loop.begin()[k]], planes);
        const bool with_the_loop = (i < j) == ((j < k) == (i < k));
        return with_the_loop == (orientation > 0) ? plane : -plane;
    };
    const Plane plane = through(order[0], order[1], order[2]);
    const bool known = plane.x != 0 || plane.y != 0 || plane.z != 0;
    return known || loop.count == 3 ? plane : through(order[1], order[2], order[3]);
}

void require_planar(const Scene& scene, CellId cell, int face, const FaceLoop& loop)
{
    if (loop.count < 4)
        return;
    const auto& points = scene.mesh().points;
    const PointId* v = loop.begin();
    if (side_of_plane(points[v[0]], points[v[1]], points[v[2]], points[v[3]]) != Sign::zero)
        throw InputError(fmt::format("cell {}: face {} of this {} is not planar; subdivide the mesh into tetrahedra",
                                     scene.caller_cells()[cell], face, name(scene.mesh().shapes[cell])));
}

void fill_block(const Scene& scene, CellId cell, FacePlanes& planes)
{
    const Mesh& mesh = scene.mesh();
    const Orientations& orientations = scene.orientations();
    const auto row = static_cast<std::size_t>(planes.row_length);
    float* block = planes.plane.data() + cell * 4 * row;
    std::fill_n(block, 4 * row, 0.0f);
    const int orientation = orientations.sign[cell];
    if (orientation == 0)
        return;
    for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
        const FaceLoop loop = face_loop(mesh, cell, face);
        if (loop.count < 3)
            continue;
        require_planar(scene, cell, face, loop);
        const Plane plane = face_plane(mesh, loop, orientation, planes);
        const auto f = static_cast<std::size_t>(face);
        block[f] = plane.x;
        block[row + f] = plane.y;
        block[2 * row + f] = plane.z;
        block[3 * row + f] = plane.offset;
    }
}

struct SingleEye {
    float x, y, z, w;
    float bound;
};

SingleEye in_single_precision(const glm::dvec4& eye)
{
    return {static_cast<float>(eye.x), static_cast<float>(eye.y), static_cast<float>(eye.z), static_cast<float>(eye.w),
            error_bound(glm::dvec3(eye), eye.w)};
}

struct SideBits {
    std::uint32_t entry;
    std::uint32_t exit;
};

template <int row_length>
SideBits filter(const float* block, const SingleEye& eye)
{
    SideBits bits{0, 0};
    for (int f = 0; f < row_length; ++f) {
        const float value = block[f] * eye.x + block[row_length + f] * eye.y + block[2 * row_length + f] * eye.z +
                            block[3 * row_length + f] * eye.w;
        bits.entry |= static_cast<std::uint32_t>(value > eye.bound) << f;
        bits.exit |= static_cast<std::uint32_t>(value < -eye.bound) << f;
    }
    return bits;
}

#if defined(__SSE2__)
template <>
SideBits filter<4>(const float* block, const SingleEye& eye)
{
    const __m128 value = _mm_add_ps(_mm_add_ps(_mm_add_ps(_mm_mul_ps(_mm_load_ps(block), _mm_set1_ps(eye.x)),
                                                          _mm_mul_ps(_mm_load_ps(block + 4), _mm_set1_ps(eye.y))),
                                               _mm_mul_ps(_mm_load_ps(block + 8), _mm_set1_ps(eye.z))),
                                    _mm_mul_ps(_mm_load_ps(block + 12), _mm_set1_ps(eye.w)));
    return {static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpgt_ps(value, _mm_set1_ps(eye.bound)))),
            static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmplt_ps(value, _mm_set1_ps(-eye.bound))))};
}
#endif

// The side of a face as its own cell lists it.
Sign listed_side(const Mesh& mesh, CellId cell, int face, const glm::dvec4& eye)
{
    const FaceLoop loop = face_loop(mesh, cell, face);
    if (loop.count < 3)
        return Sign::zero;
    const auto side = [&](PointId a, PointId b, PointId c) {
        return side_of_plane(mesh.points[a], mesh.points[b], mesh.points[c], eye);
    };
    if (loop.count == 3)
        return side(loop.vertices[0], loop.vertices[1], loop.vertices[2]);
    const auto triple = spanning_triple(mesh, loop);
    return triple ? side(triple->a, triple->b, triple->c) : Sign::zero;
}

template <int row_length>
void evaluate_range(const Scene& scene, const FacePlanes& planes, const SingleEye& unit, const glm::dvec4& eye,
                    const Range& range, std::uint16_t* bits)
{
    constexpr std::uint32_t all = (1u << row_length) - 1;
    for (CellId cell = range.begin(); cell < range.end(); ++cell) {
        SideBits sides = filter<row_length>(planes.plane.data() + std::size_t{cell} * 4 * row_length, unit);
        if (const std::uint32_t open = all & ~(sides.entry | sides.exit); open != 0) [[unlikely]] {
            for (int face = 0; face < face_count(scene.mesh().shapes[cell]); ++face) {
                if ((open >> face & 1u) == 0)
                    continue;
                const Sign side = exact_face_side(scene, cell, face, eye);
                sides.entry |= static_cast<std::uint32_t>(side == Sign::positive) << face;
                sides.exit |= static_cast<std::uint32_t>(side == Sign::negative) << face;
            }
        }
        bits[cell] = static_cast<std::uint16_t>(sides.entry | sides.exit << 8);
    }
}

} // namespace

FacePlanes derive_face_planes(const Scene& scene)
{
    if (scene.is_surface())
        throw InputError("the triangles of a surface scene bound no cells: it has no face planes");
    FacePlanes planes;
    planes.row_length = scene.adjacency().row_length;
    const Box& box = scene.bounds();
    planes.origin = box.middle();
    const glm::dvec3 half = box.max * 0.5 - box.min * 0.5;
    const double radius = std::max({half.x, half.y, half.z});
    // The rounded origin may lie off the middle by an ulp; one power of two more keeps unit coordinates in [-1, 1].
    planes.scale = radius > 0 ? std::ldexp(1.0, -std::ilogb(radius) - 1) : 1.0;
    if (!std::isnormal(planes.scale))
        planes.scale = 1.0;
    planes.plane.resize(std::size_t{scene.cell_count()} * 4 * static_cast<std::size_t>(planes.row_length));
    const Orientations& orientations = scene.orientations();
    oneapi::tbb::parallel_for(Range(0, scene.cell_count(), 4096), [&](const Range& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell)
            fill_block(scene, cell, planes);
    });
    for (const auto& [cell, face] : orientations.folded) {
        float* block = planes.plane.data() + std::size_t{cell} * 4 * static_cast<std::size_t>(planes.row_length);
        for (int k = 0; k < 4; ++k)
            block[k * planes.row_length + static_cast<int>(face)] = 0;
    }
    return planes;
}

// A positive scale changes no side of a face; a negative weight turns all of them, as the eye's position is then that
// of
// (-p, -w).
glm::dvec4 unit_eye(const FacePlanes& planes, const glm::dvec4& eye)
{
    glm::dvec3 e(eye);
    if (eye.w == 1)
        e -= planes.origin;
    else if (eye.w != 0)
        e = {std::fma(-eye.w, planes.origin.x, e.x), std::fma(-eye.w, planes.origin.y, e.y),
             std::fma(-eye.w, planes.origin.z, e.z)};
    e *= planes.scale;
    const double largest = std::max({std::abs(e.x), std::abs(e.y), std::abs(e.z), std::abs(eye.w)});
    // A direction so short that scaling rounds it to nothing is left to the exact predicate.
    if (largest == 0)
        return glm::dvec4(0);
    const double scale = std::ldexp(eye.w < 0 ? -1.0 : 1.0, -std::ilogb(largest));
    return {e * scale, eye.w * scale};
}

Sign exact_face_side(const Scene& scene, CellId cell, int face, const glm::dvec4& eye)
{
    const Mesh& mesh = scene.mesh();
    const Orientations& orientations = scene.orientations();
    const CellId neighbour = scene.adjacency().row(cell)[static_cast<std::size_t>(face)];
    const auto as_sign = [](int s) { return static_cast<Sign>(s); };
    const int orientation = orientations.sign[cell];
    if (orientation != 0) {
        const CellFace this_face{cell, static_cast<std::uint32_t>(face)};
        if (!orientations.folded.empty() && std::binary_search(orientations.folded.begin(), orientations.folded.end(),
                                                               this_face, [](const CellFace& a, const CellFace& b) {
                                                                   return std::pair(a.cell, a.face) <
                                                                          std::pair(b.cell, b.face);
                                                               }))
            return Sign::zero;
        return listed_side(mesh, cell, face, eye) * as_sign(orientation);
    }
    if (neighbour == cell) {
        const bool turned = std::binary_search(orientations.turned_flat.begin(), orientations.turned_flat.end(), cell);
        const Sign side = listed_side(mesh, cell, face, eye);
        return turned ? -side : side;
    }
    const Sign listed_there = listed_side(mesh, neighbour, matching_face(scene, cell, face), eye);
    if (orientations.sign[neighbour] != 0)
        return -(listed_there * as_sign(orientations.sign[neighbour]));
    return scene.caller_cells()[cell] < scene.caller_cells()[neighbour] ? listed_side(mesh, cell, face, eye)
                                                                        : -listed_there;
}

void FaceSigns::evaluate(const Scene& scene, const glm::dvec4& eye)
{
    const FacePlanes& planes = scene.face_planes();
    const SingleEye unit = in_single_precision(unit_eye(planes, eye));
    bits_.resize(scene.cell_count());
    oneapi::tbb::parallel_for(Range(0, scene.cell_count(), 16384), [&](const Range& range) {
        if (planes.row_length == 4)
            evaluate_range<4>(scene, planes, unit, eye, range, bits_.data());
        else
            evaluate_range<6>(scene, planes, unit, eye, range, bits_.data());
    });
}

} // namespace visorder
