#include "depth/obstruction.h"

#include "geometry/exact_predicates.h"
#include "scene/adjacency.h"
#include "scene/face_planes.h"
#include "scene/orientations.h"
#include "scene/seen_face.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <span>
#include <utility>

namespace visorder::detail {

namespace {

template <class Body>
void each_cell(const Scene& scene, const Body& body)
{
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, scene.cell_count(), 512), [&](const auto& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell)
            body(cell);
    });
}

bool is_planar(const Mesh& mesh, const FaceLoop& loop)
{
    const PointId* v = loop.begin();
    return loop.count < 4 ||
           side_of_plane(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]) == Sign::zero;
}

bool is_none(const FaceTriple& triple)
{
    return triple.a == triple.b;
}

// The plane of three points, asked for the sides of many others: the filter of side_of_plane with what depends on the
// plane taken out. The bound is Shewchuk's (7 + 56 u) u times the permanent (1997, section 4.3), rounded up to 9 u, and
// more than what underflow can add; overflow makes value or bound infinite or NaN, which decides nothing.
class Plane {
public:
    Plane(const Mesh& mesh, const FaceTriple& triple) : points_(mesh.points), triple_(triple)
    {
        const glm::dvec3 &a = points_[triple.a], p = points_[triple.b] - a, q = points_[triple.c] - a;
        const double x1 = p.y * q.z, x2 = p.z * q.y;
        const double y1 = p.z * q.x, y2 = p.x * q.z;
        const double z1 = p.x * q.y, z2 = p.y * q.x;
        normal_ = {x1 - x2, y1 - y2, z1 - z2};
        permanent_ = {std::abs(x1) + std::abs(x2), std::abs(y1) + std::abs(y2), std::abs(z1) + std::abs(z2)};
    }

    // side_of_plane(a, b, c, v).
    Sign side(PointId v) const
    {
        const glm::dvec3 d = points_[v] - points_[triple_.a];
        const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
        const double value = normal_.x * d.x + normal_.y * d.y + normal_.z * d.z;
        const double bound =
            1e-15 * (permanent_.x * x + permanent_.y * y + permanent_.z * z) + 1e-300 * (1 + x + y + z);
        if (std::abs(value) > bound) [[likely]]
            return value > 0 ? Sign::positive : Sign::negative;
        // Cells that meet share vertices; exact arithmetic need not find that out.
        if (v == triple_.a || v == triple_.b || v == triple_.c)
            return Sign::zero;
        return side_of_plane(points_[triple_.a], points_[triple_.b], points_[triple_.c], points_[v]);
    }

private:
    const std::vector<glm::dvec3>& points_;
    const FaceTriple& triple_;
    glm::dvec3 normal_;
    glm::dvec3 permanent_;
};

std::uint8_t bit(int face)
{
    return static_cast<std::uint8_t>(1u << face);
}

bool covers(Overlap overlap)
{
    return overlap == Overlap::nearer || overlap == Overlap::coincident;
}

} // namespace

Obstruction::Obstruction(const Scene& scene)
    : scene_(scene),
      row_length_(scene.is_surface()       ? 1
                  : scene.is_tetrahedral() ? 4
                                           : 6),
      triples_(scene.cell_count() * static_cast<std::size_t>(row_length_)),
      seen_(scene.cell_count())
{
    const Mesh& mesh = scene.mesh();
    constexpr FaceTriple none{0, 0, 0};
    std::fill(triples_.begin(), triples_.end(), none);
    std::atomic<bool> planar{true}, flat{false};
    LargeArray<std::uint8_t> is_flat(scene.cell_count());
    each_cell(scene, [&](CellId cell) {
        is_flat[cell] = 0;
        if (is_collapsed(mesh, cell))
            return;
        FaceTriple* row = &triples_[std::size_t{cell} * static_cast<std::size_t>(row_length_)];
        const auto v = mesh.cell(cell);
        if (scene.is_surface()) {
            *row = {v[0], v[1], v[2]};
            return;
        }
        const Sign orientation = orientation_of(mesh, cell);
        if (orientation == Sign::zero) {
            is_flat[cell] = 1;
            flat.store(true, std::memory_order_relaxed);
        }
        for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
            const FaceLoop loop = face_loop(mesh, cell, face);
            if (!is_planar(mesh, loop))
                planar.store(false, std::memory_order_relaxed);
            if (orientation == Sign::zero)
                continue;
            // All faces of a tetrahedron that is not flat have areas.
            const auto spanning = mesh.shapes[cell] == CellShape::tetrahedron
                                      ? FaceTriple{loop.vertices[0], loop.vertices[1], loop.vertices[2]}
                                      : spanning_triple(mesh, loop).value_or(none);
            row[face] = orientation == Sign::negative ? FaceTriple{spanning.a, spanning.c, spanning.b} : spanning;
        }
    });
    planar_ = planar;
    if (flat) {
        flat_ = std::move(is_flat);
        scene.adjacency();
        scene.orientations();
    }
}

void Obstruction::look_from(const glm::dvec4& eye)
{
    eye_ = eye;
    const Mesh& mesh = scene_.mesh();
    each_cell(scene_, [&](CellId cell) {
        Seen seen{0, 0};
        for (int face = 0; face < row_length_; ++face) {
            const FaceTriple& t = triple(cell, face);
            if (is_none(t))
                continue;
            const Sign side = side_of_plane(mesh.points[t.a], mesh.points[t.b], mesh.points[t.c], eye);
            if (side == Sign::positive)
                seen.entry |= bit(face);
            else if (side == Sign::negative)
                seen.exit |= bit(face);
        }
        seen_[cell] = seen;
    });
}

SeenFace Obstruction::seen_face_of(CellId cell, int face) const
{
    return seen_face(scene_.mesh(), {cell, static_cast<std::uint32_t>(face)}, eye_);
}

// Whether all vertices of `other` lie on a side of a face's plane, or in it.
bool Obstruction::has_on_side(CellId cell, int face, Sign side, CellId other) const
{
    const auto v = scene_.mesh().cell(other);
    const Plane plane(scene_.mesh(), triple(cell, face));
    return std::all_of(v.begin(), v.end(), [&](PointId p) { return plane.side(p) != -side; });
}

Settled Obstruction::test(CellId front, CellId back) const
{
    if (is_flat(front) || is_flat(back))
        return obstructs_beside_flat(front, back) ? Settled::obstructs : Settled::apart;
    if (scene_.is_surface()) {
        if (has_on_side(front, 0, eye_side_of_triangle(front), back))
            return Settled::by_front_plane;
        if (has_on_side(back, 0, -eye_side_of_triangle(back), front))
            return Settled::by_back_plane;
        return definitive(front, back);
    }
    // A plane through the eye does as well: no ray leads from one of its sides to the other.
    for (int face = 0; face < row_length_; ++face)
        if ((seen_[front].exit & bit(face)) == 0 && !is_none(triple(front, face)) &&
            has_on_side(front, face, Sign::positive, back))
            return Settled::by_front_plane;
    for (int face = 0; face < row_length_; ++face)
        if ((seen_[back].entry & bit(face)) == 0 && !is_none(triple(back, face)) &&
            has_on_side(back, face, Sign::positive, front))
            return Settled::by_back_plane;
    return definitive(front, back);
}

Settled Obstruction::definitive(CellId front, CellId back) const
{
    if (scene_.is_surface())
        return face_overlap(seen_face_of(front, 0), seen_face_of(back, 0), eye_) == Overlap::nearer ? Settled::obstructs
                                                                                                    : Settled::apart;
    const auto faces = [&](CellId cell, std::uint32_t bits, std::array<SeenFace, max_cell_faces>& seen) {
        std::size_t count = 0;
        for (int face = 0; bits != 0; bits >>= 1, ++face)
            if ((bits & 1u) != 0)
                seen[count++] = seen_face_of(cell, face);
        return std::span(seen).first(count);
    };
    std::array<SeenFace, max_cell_faces> exits, entries;
    const auto exits_of_front = faces(front, seen_[front].exit, exits);
    const auto entries_of_back = faces(back, seen_[back].entry, entries);
    bool nearer = false;
    for (const SeenFace& f : exits_of_front)
        for (const SeenFace& g : entries_of_back) {
            const Overlap overlap = face_overlap(f, g, eye_);
            if (overlap == Overlap::farther || overlap == Overlap::crossing)
                return Settled::apart;
            nearer |= covers(overlap);
        }
    return nearer ? Settled::obstructs : Settled::apart;
}

// Across the faces that a flat cell shares with the solid cells around it; from others, nothing occludes it.
bool Obstruction::obstructs_beside_flat(CellId front, CellId back) const
{
    const auto row = scene_.adjacency().row(front);
    for (std::size_t face = 0; face < row.size(); ++face)
        if (row[face] == back && exact_face_side(scene_, front, static_cast<int>(face), eye_) == Sign::negative)
            return true;
    return false;
}

} // namespace visorder::detail
