#include "scene/traits.h"

#include "geometry/box_hierarchy.h"
#include "geometry/exact_predicates.h"
#include "geometry/face_overlap.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/circumspheres.h"
#include "scene/face_loop.h"
#include "scene/orientations.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>
#include <vector>

namespace visorder::detail {

namespace {

template <class Holds>
bool all_of_range(std::size_t n, Holds&& holds)
{
    std::atomic<bool> all{true};
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, n, 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end() && all.load(std::memory_order_relaxed); ++i)
            if (!holds(i))
                all.store(false, std::memory_order_relaxed);
    });
    return all;
}

bool has_planar_faces(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    return scene.is_tetrahedral() || all_of_range(scene.cell_count(), [&](std::size_t i) {
               const auto cell = static_cast<CellId>(i);
               for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
                   const FaceLoop loop = face_loop(mesh, cell, face);
                   const PointId* v = loop.begin();
                   if (loop.count == 4 && side_of_plane(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]],
                                                        mesh.points[v[3]]) != Sign::zero)
                       return false;
               }
               return true;
           });
}

// A boundary face with a plane, from outside of its cell.
struct OuterFace {
    FaceLoop loop;
    FaceTriple triple;
};

class ConvexityTest {
public:
    explicit ConvexityTest(const Scene& scene) : scene_(scene), points_(scene.mesh().points)
    {
        const auto& sign = scene.orientations().sign;
        for (const auto& [cell, face] : scene.boundary().faces) {
            const FaceLoop loop = face_loop(scene.mesh(), cell, static_cast<int>(face));
            auto triple = spanning_triple(scene.mesh(), loop);
            if (!triple) {
                all_have_planes_ = false;
                continue;
            }
            if (sign[cell] < 0)
                std::swap(triple->b, triple->c);
            faces_.push_back({loop, *triple});
        }
    }

    // A closed surface that is connected and convex at every edge bounds a convex body (van Heijenoort 1952), if it
    // does not wind around a vertex more than once; then cells overlap there. Where faces without a plane hide an edge
    // from that test, every vertex is held against every face.
    bool holds() const
    {
        if (!scene_.adjacency().folded.empty() || !scene_.adjacency().crowded.empty() ||
            scene_.boundary().component_count != 1)
            return false;
        return (all_have_planes_ ? convex_at_every_edge() : behind_every_face()) && scene_.overlapping_cells().empty();
    }

private:
    struct Edge {
        PointId low, high;
        std::uint32_t face;
    };

    Sign side(const OuterFace& face, const glm::dvec4& eye) const
    {
        return side_of_plane(points_[face.triple.a], points_[face.triple.b], points_[face.triple.c], eye);
    }

    bool convex_between(const OuterFace& f, const OuterFace& g) const
    {
        bool coplanar = true;
        for (PointId v : g.loop) {
            const Sign s = side(f, glm::dvec4(points_[v], 1));
            if (s == Sign::positive)
                return false;
            coplanar = coplanar && s == Sign::zero;
        }
        // Of two faces in one plane, one turned against the other is the far side of a slit.
        for (int axis = 0; coplanar && axis < 3; ++axis) {
            glm::dvec4 direction(0);
            direction[axis] = 1;
            if (side(f, direction) != side(g, direction))
                return false;
        }
        return true;
    }

    bool convex_at_every_edge() const
    {
        std::vector<Edge> edges;
        for (std::uint32_t i = 0; i < faces_.size(); ++i) {
            const FaceLoop& loop = faces_[i].loop;
            for (int k = 0; k < loop.count; ++k) {
                const PointId a = loop.begin()[k], b = loop.begin()[(k + 1) % loop.count];
                edges.push_back({std::min(a, b), std::max(a, b), i});
            }
        }
        std::sort(edges.begin(), edges.end(),
                  [](const Edge& a, const Edge& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
        if (edges.size() % 2 != 0)
            return false;
        return all_of_range(edges.size() / 2, [&](std::size_t pair) {
            const std::size_t i = 2 * pair;
            const auto same = [&](std::size_t j) {
                return edges[i].low == edges[j].low && edges[i].high == edges[j].high;
            };
            const bool two_faces = same(i + 1) && (i + 2 == edges.size() || !same(i + 2));
            return two_faces && convex_between(faces_[edges[i].face], faces_[edges[i + 1].face]) &&
                   convex_between(faces_[edges[i + 1].face], faces_[edges[i].face]);
        });
    }

    bool behind_every_face() const
    {
        std::vector<PointId> vertices;
        for (const OuterFace& face : faces_)
            vertices.insert(vertices.end(), face.loop.begin(), face.loop.end());
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        return !faces_.empty() && all_of_range(faces_.size(), [&](std::size_t i) {
            return std::all_of(vertices.begin(), vertices.end(),
                               [&](PointId v) { return side(faces_[i], glm::dvec4(points_[v], 1)) != Sign::positive; });
        });
    }

    const Scene& scene_;
    const std::vector<glm::dvec3>& points_;
    std::vector<OuterFace> faces_;
    bool all_have_planes_ = true;
};

// Cells that touch elsewhere than in whole faces have boundary faces in one plane with area in common.
bool meets_face_to_face(const Scene& scene)
{
    if (!scene.adjacency().folded.empty() || !scene.adjacency().crowded.empty())
        return false;
    const Mesh& mesh = scene.mesh();
    const auto& faces = scene.boundary().faces;
    const auto points_of = [&](std::size_t i, std::array<glm::dvec3, max_face_vertices>& points) {
        const FaceLoop loop = face_loop(mesh, faces[i].cell, static_cast<int>(faces[i].face));
        std::transform(loop.begin(), loop.end(), points.begin(), [&](PointId v) { return mesh.points[v]; });
        return std::span<const glm::dvec3>(points.data(), static_cast<std::size_t>(loop.count));
    };
    std::vector<Box> boxes(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        std::array<glm::dvec3, max_face_vertices> points;
        for (const glm::dvec3& p : points_of(i, points))
            boxes[i].add(p);
    }
    const BoxHierarchy hierarchy(boxes);
    return all_of_range(faces.size(), [&](std::size_t i) {
        std::array<glm::dvec3, max_face_vertices> f_points, g_points;
        const auto f = points_of(i, f_points);
        const auto triple = spanning_triple(mesh, face_loop(mesh, faces[i].cell, static_cast<int>(faces[i].face)));
        if (!triple)
            return true;
        const auto side = [&](const glm::dvec4& eye) {
            return side_of_plane(mesh.points[triple->a], mesh.points[triple->b], mesh.points[triple->c], eye);
        };
        glm::dvec4 across(0); // an axis that the plane does not contain
        for (int axis = 0; axis < 3 && across == glm::dvec4(0); ++axis) {
            glm::dvec4 direction(0);
            direction[axis] = 1;
            if (side(direction) != Sign::zero)
                across = direction;
        }
        bool alone = true;
        hierarchy.search([&](const Box& box) { return box.meets(boxes[i]); },
                         [&](std::uint32_t j) {
                             if (j <= i)
                                 return true;
                             const auto g = points_of(j, g_points);
                             const bool coplanar = std::all_of(g.begin(), g.end(), [&](const glm::dvec3& p) {
                                 return side(glm::dvec4(p, 1)) == Sign::zero;
                             });
                             alone = !coplanar ||
                                     spanning_triple(mesh,
                                                     face_loop(mesh, faces[j].cell, static_cast<int>(faces[j].face))) ==
                                         std::nullopt ||
                                     face_overlap(f, g, across) == Overlap::disjoint;
                             return alone;
                         });
        return alone;
    });
}

class DelaunayTest {
public:
    explicit DelaunayTest(const Scene& scene) : scene_(scene), mesh_(scene.mesh()) {}

    // A mesh that is Delaunay across every interior face is so as a whole if it is convex. If it is not, a point inside
    // some cell's sphere is reached from there through a boundary face, and is inside the sphere of that face's owner
    // too, for the power of the point falls from cell to cell along the way: owners of boundary faces are enough.
    bool holds(bool convex) const
    {
        const Orientations& orientations = scene_.orientations();
        if (!scene_.is_tetrahedral() || orientations.flat != 0 || !scene_.adjacency().folded.empty() ||
            !scene_.adjacency().crowded.empty())
            return false;
        if (!all_of_range(scene_.cell_count(),
                          [&](std::size_t cell) { return across_faces(static_cast<CellId>(cell)); }))
            return false;
        return convex || owners_are_empty();
    }

private:
    bool inside_sphere(CellId cell, PointId point) const
    {
        const auto v = mesh_.cell(cell);
        const bool turned = scene_.orientations().sign[cell] < 0;
        return in_circumsphere(mesh_.points[v[0]], mesh_.points[v[turned ? 2 : 1]], mesh_.points[v[turned ? 1 : 2]],
                               mesh_.points[v[3]], mesh_.points[point]) == Sign::positive;
    }

    bool across_faces(CellId cell) const
    {
        const auto v = mesh_.cell(cell);
        for (CellId neighbour : scene_.adjacency().row(cell)) {
            if (neighbour <= cell)
                continue;
            const auto w = mesh_.cell(neighbour);
            const auto opposite = std::find_if(w.begin(), w.end(),
                                               [&](PointId p) { return std::find(v.begin(), v.end(), p) == v.end(); });
            if (opposite == w.end() || inside_sphere(cell, *opposite))
                return false;
        }
        return true;
    }

    bool owners_are_empty() const
    {
        std::vector<Box> boxes(mesh_.points.size());
        for (std::size_t i = 0; i < boxes.size(); ++i)
            boxes[i].add(mesh_.points[i]);
        const BoxHierarchy points(boxes);
        const Circumspheres& spheres = scene_.circumspheres();
        const auto& faces = scene_.boundary().faces;
        return all_of_range(faces.size(), [&](std::size_t i) {
            const CellId cell = faces[i].cell;
            const glm::dvec3 centre = spheres.centre[cell];
            const double square = glm::dot(centre, centre) - spheres.constant[cell];
            // Wide enough for every rounding here; what it lets through is decided exactly.
            const double reach = square + 1e-9 * glm::dot(centre, centre) + 1e-9 * square;
            bool empty = true;
            points.search(
                [&](const Box& box) {
                    const glm::dvec3 nearest = glm::clamp(centre, box.min - spheres.origin, box.max - spheres.origin);
                    return glm::dot(nearest - centre, nearest - centre) <= reach;
                },
                [&](std::uint32_t point) {
                    const auto v = mesh_.cell(cell);
                    empty = std::find(v.begin(), v.end(), point) != v.end() || !inside_sphere(cell, point);
                    return empty;
                });
            return empty;
        });
    }

    const Scene& scene_;
    const Mesh& mesh_;
};

} // namespace

Traits derive_traits(const Scene& scene)
{
    const Orientations& orientations = scene.orientations();
    Traits traits{};
    traits.flat_cells = orientations.flat;
    if (scene.is_surface())
        return traits;
    traits.inverted_cells = orientations.inverted;
    traits.folded_faces = scene.adjacency().folded.size() / 2;
    traits.crowded_faces = scene.adjacency().crowded.size();
    traits.planar_faces = has_planar_faces(scene);
    traits.face_to_face = traits.planar_faces && meets_face_to_face(scene);
    traits.convex = traits.planar_faces && ConvexityTest(scene).holds();
    traits.delaunay = DelaunayTest(scene).holds(traits.convex);
    return traits;
}

} // namespace visorder::detail
