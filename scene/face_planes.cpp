#include "scene/face_planes.h"

#include "scene/adjacency.h"
#include "scene/face_loop.h"
#include "scene/orientations.h"
#include "visorder/error.h"
#include "visorder/scene.h"

#include <algorithm>
#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace visorder::detail {

namespace {

using Range = oneapi::tbb::blocked_range<CellId>;

// The outward plane of a face of a solid cell, from its vertices in ascending order, so that both its cells compute the
// same numbers.
UnitPlane face_plane(const Mesh& mesh, const FaceLoop& loop, int orientation, const UnitFrame& frame)
{
    std::array<int, max_face_vertices> order{0, 1, 2, 3};
    std::sort(order.begin(), order.begin() + loop.count,
              [&](int i, int j) { return loop.begin()[i] < loop.begin()[j]; });
    const auto through = [&](int i, int j, int k) {
        const UnitPlane plane =
            unit_plane(frame, mesh.points[loop.begin()[i]], mesh.points[loop.begin()[j]], mesh.points[loop.begin()[k]]);
        const bool with_the_loop = (i < j) == ((j < k) == (i < k));
        return with_the_loop == (orientation > 0) ? plane : -plane;
    };
    const UnitPlane plane = through(order[0], order[1], order[2]);
    return plane.known() || loop.count == 3 ? plane : through(order[1], order[2], order[3]);
}

void require_planar(const Scene& scene, CellId cell, int face, const FaceLoop& loop)
{
    if (loop.count < 4)
        return;
    const auto& points = scene.mesh().points;
    const PointId* v = loop.begin();
    if (side_of_plane(points[v[0]], points[v[1]], points[v[2]], points[v[3]]) != Sign::zero)
        throw CellError(scene.caller_cells()[cell],
                        fmt::format("face {} of this {} is not planar; subdivide the mesh into tetrahedra", face,
                                    name(scene.mesh().shapes[cell])));
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
        const UnitPlane plane = face_plane(mesh, loop, orientation, planes.frame);
        const auto f = static_cast<std::size_t>(face);
        block[f] = plane.x;
        block[row + f] = plane.y;
        block[2 * row + f] = plane.z;
        block[3 * row + f] = plane.offset;
    }
}

struct SideBits {
    std::uint32_t entry;
    std::uint32_t exit;
};

template <int row_length>
SideBits filter(const float* block, const UnitEye& eye)
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
SideBits filter<4>(const float* block, const UnitEye& eye)
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
void evaluate_range(const Scene& scene, const FacePlanes& planes, const UnitEye& unit, const glm::dvec4& eye,
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
    planes.frame = unit_frame(scene.bounds());
    planes.plane.resize(std::size_t{scene.cell_count()} * 4 * static_cast<std::size_t>(planes.row_length));
    oneapi::tbb::parallel_for(Range(0, scene.cell_count(), 4096), [&](const Range& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell)
            fill_block(scene, cell, planes);
    });
    return planes;
}

Sign exact_face_side(const Scene& scene, CellId cell, int face, const glm::dvec4& eye)
{
    const auto& sign = scene.orientations().sign;
    const auto as_sign = [](int s) { return static_cast<Sign>(s); };
    if (sign[cell] != 0)
        return listed_side(scene.mesh(), cell, face, eye) * as_sign(sign[cell]);
    const CellId neighbour = scene.adjacency().row(cell)[static_cast<std::size_t>(face)];
    if (neighbour == cell)
        return Sign::zero;
    return -(listed_side(scene.mesh(), neighbour, matching_face(scene, cell, face), eye) * as_sign(sign[neighbour]));
}

void FaceSigns::evaluate(const Scene& scene, const glm::dvec4& eye)
{
    const FacePlanes& planes = scene.face_planes();
    const UnitEye unit(planes.frame, eye);
    bits_.resize(scene.cell_count());
    oneapi::tbb::parallel_for(Range(0, scene.cell_count(), 16384), [&](const Range& range) {
        if (planes.row_length == 4)
            evaluate_range<4>(scene, planes, unit, eye, range, bits_.data());
        else
            evaluate_range<6>(scene, planes, unit, eye, range, bits_.data());
    });
}

} // namespace visorder::detail
