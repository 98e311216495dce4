#include "scene/overlapping_cells.h"

#include "geometry/box_hierarchy.h"
#include "geometry/exact_predicates.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "scene/orientations.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

// Where two cells overlap, either one of them is found at the boundary or the mesh is folded. Take a point in both, and
// follow a line from it in general position, keeping track of which of the cells it is in: across an interior face that
// is not folded, each of the two goes on into exactly one cell, and two different cells into two different ones. The
// scene being finite, one of the two comes to a boundary face, of cell c, while in the other, d; c and d overlap there.
// If d ends there too, two owners of boundary faces overlap. Else walk over the piece of the boundary that c's face
// belongs to, just inside. Either the other cell goes on into a neighbour all the way, and then the owner of every face
// of the piece overlaps some cell; or it ends at a boundary face on the way, and there two owners overlap. So a scene
// without overlaps is one with
//   no folded interior face, and none that more than two cells share,
//   no two overlapping owners of boundary faces, and
//   of each piece of the boundary one face whose owner overlaps no cell.
// For this, flat cells are left out, and the faces of their solid neighbours are boundary faces; each of these is taken
// as a piece of its own, since nothing says how they hang together.

namespace visorder::detail {

namespace {

struct Vertices {
    std::array<PointId, max_cell_vertices> ids;
    int count = 0;

    const PointId* begin() const { return ids.data(); }
    const PointId* end() const { return ids.data() + count; }
};

Vertices distinct_vertices(const Mesh& mesh, CellId cell)
{
    Vertices vertices;
    for (PointId v : mesh.cell(cell))
        if (std::find(vertices.begin(), vertices.end(), v) == vertices.end())
            vertices.ids[static_cast<std::size_t>(vertices.count++)] = v;
    return vertices;
}

Box box_of(const Mesh& mesh, CellId cell)
{
    Box box;
    for (PointId v : mesh.cell(cell))
        box.add(mesh.points[v]);
    return box;
}

bool interiors_meet(const Box& a, const Box& b)
{
    return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y && a.min.z < b.max.z &&
           b.min.z < a.max.z;
}

// Whether the plane through three points has all of a weakly on one side and all of b weakly on the other. The three
// may be collinear: then they span no plane, and all of a solid cell seems to lie in it.
bool plane_separates(const Mesh& mesh, const FaceTriple& plane, const Vertices& a, const Vertices& b)
{
    const auto side = [&](PointId v) {
        if (v == plane.a || v == plane.b || v == plane.c)
            return Sign::zero;
        return side_of_plane(mesh.points[plane.a], mesh.points[plane.b], mesh.points[plane.c], mesh.points[v]);
    };
    Sign side_of_a = Sign::zero;
    for (PointId v : a) {
        const Sign s = side(v);
        if (s != Sign::zero && s == -side_of_a)
            return false;
        if (s != Sign::zero)
            side_of_a = s;
    }
    return side_of_a != Sign::zero && std::none_of(b.begin(), b.end(), [&](PointId v) { return side(v) == side_of_a; });
}

bool face_separates(const Mesh& mesh, CellId cell, const Vertices& of_cell, const Vertices& other)
{
    for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
        const FaceLoop loop = face_loop(mesh, cell, face);
        if (loop.count < 3)
            continue;
        FaceTriple triple{loop.vertices[0], loop.vertices[1], loop.vertices[2]};
        if (loop.count == 4) {
            const auto spanning = spanning_triple(mesh, loop);
            if (!spanning)
                continue;
            triple = *spanning;
        }
        if (plane_separates(mesh, triple, of_cell, other))
            return true;
    }
    return false;
}

// Planes through two vertices of a and one of b. Only edges of a can span one that separates, and testing all pairs
// spares finding out which are edges.
bool edge_and_vertex_separate(const Mesh& mesh, const Vertices& a, const Vertices& b)
{
    for (const PointId* i = a.begin(); i != a.end(); ++i)
        for (const PointId* j = i + 1; j != a.end(); ++j)
            for (PointId v : b)
                if (v != *i && v != *j && plane_separates(mesh, {*i, *j, v}, a, b))
                    return true;
    return false;
}

// Two convex bodies with interiors have these in common unless a plane separates the bodies weakly. The separating
// planes n x <= c of a, n x >= c of b are the rays of a polyhedral cone of (n, c) without a line in it, so if there are
// any, one is an extreme ray: a plane that holds three vertices of the two which span it. Three of a lie in one face of
// a then; else two of them are an edge of one, and the third is a vertex of the other.
bool solids_overlap(const Mesh& mesh, CellId a, CellId b)
{
    const Vertices of_a = distinct_vertices(mesh, a), of_b = distinct_vertices(mesh, b);
    return !face_separates(mesh, a, of_a, of_b) && !face_separates(mesh, b, of_b, of_a) &&
           !edge_and_vertex_separate(mesh, of_a, of_b) && !edge_and_vertex_separate(mesh, of_b, of_a);
}

class OverlapSearch {
public:
    explicit OverlapSearch(const Scene& scene)
        : mesh_(scene.mesh()), adjacency_(scene.adjacency()), orientations_(scene.orientations()), scene_(scene)
    {
    }

    std::vector<std::pair<CellId, CellId>> run() const
    {
        if (adjacency_.folded.empty() && adjacency_.crowded.empty() && !overlap_at_boundary())
            return {};
        return all_pairs();
    }

private:
    bool is_solid(CellId cell) const { return orientations_.sign[cell] != 0; }

    // Neighbours lie on different sides of the face that they share.
    bool overlap(CellId a, CellId b) const { return !adjacency_.joins(a, b) && solids_overlap(mesh_, a, b); }

    // The solid cells with a face on whose other side is no solid one, ascending; and those of them that stand for a
    // piece of the boundary.
    struct Owners {
        std::vector<CellId> all;
        std::vector<CellId> of_pieces;
    };

    Owners owners_of_boundary() const
    {
        Owners owners;
        const Boundary& boundary = scene_.boundary();
        std::vector<bool> seen(boundary.component_count, false);
        for (std::size_t i = 0; i < boundary.faces.size(); ++i) {
            const CellId cell = boundary.faces[i].cell;
            if (!is_solid(cell))
                continue;
            owners.all.push_back(cell);
            if (!seen[boundary.component[i]])
                owners.of_pieces.push_back(cell);
            seen[boundary.component[i]] = true;
        }
        for (CellId flat = 0; orientations_.flat > 0 && flat < scene_.cell_count(); ++flat)
            if (!is_solid(flat))
                for (CellId neighbour : adjacency_.row(flat))
                    if (is_solid(neighbour)) {
                        owners.all.push_back(neighbour);
                        owners.of_pieces.push_back(neighbour);
                    }
        for (std::vector<CellId>* cells : {&owners.all, &owners.of_pieces}) {
            std::sort(cells->begin(), cells->end());
            cells->erase(std::unique(cells->begin(), cells->end()), cells->end());
        }
        return owners;
    }

    // Visits the overlapping pairs of one of `queries` and one of `cells`, both solid, in parallel, in no order, until
    // `visit` returns false.
    template <class Cells, class Queries, class Visit>
    void visit_pairs(const Cells& cells, std::size_t cell_count, const Queries& queries, std::size_t query_count,
                     Visit&& visit) const
    {
        std::vector<Box> boxes(cell_count);
        for (std::size_t i = 0; i < cell_count; ++i)
            boxes[i] = box_of(mesh_, cells(i));
        const BoxHierarchy hierarchy(boxes);
        std::vector<Box>().swap(boxes);
        std::atomic<bool> go_on{true};
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, query_count, 256), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end() && go_on.load(std::memory_order_relaxed); ++i) {
                const CellId a = queries(i);
                if (!is_solid(a))
                    continue;
                const Box box = box_of(mesh_, a);
                hierarchy.search([&](const Box& other) { return interiors_meet(box, other); },
                                 [&](std::uint32_t k) {
                                     const CellId b = cells(k);
                                     if (a != b && is_solid(b) && visit.wants(a, b) && overlap(a, b) &&
                                         !visit.found(a, b))
                                         go_on.store(false, std::memory_order_relaxed);
                                     return go_on.load(std::memory_order_relaxed);
                                 });
            }
        });
    }

    bool overlap_at_boundary() const
    {
        struct Any {
            bool each_pair_once;
            std::atomic<bool> any{false};

            bool wants(CellId a, CellId b) const { return !each_pair_once || a < b; }
            bool found(CellId, CellId)
            {
                any.store(true, std::memory_order_relaxed);
                return false;
            }
        };
        const Owners owners = owners_of_boundary();
        const auto owner = [&](std::size_t i) { return owners.all[i]; };
        Any among_owners{true};
        visit_pairs(owner, owners.all.size(), owner, owners.all.size(), among_owners);
        if (among_owners.any)
            return true;
        const auto owner_of_piece = [&](std::size_t i) { return owners.of_pieces[i]; };
        Any with_pieces{false};
        visit_pairs(
            owner_of_piece, owners.of_pieces.size(), [](std::size_t i) { return static_cast<CellId>(i); },
            scene_.cell_count(), with_pieces);
        return with_pieces.any;
    }

    std::vector<std::pair<CellId, CellId>> all_pairs() const
    {
        struct All {
            oneapi::tbb::enumerable_thread_specific<std::vector<std::pair<CellId, CellId>>> pairs;

            bool wants(CellId a, CellId b) const { return a < b; }
            bool found(CellId a, CellId b)
            {
                pairs.local().emplace_back(a, b);
                return true;
            }
        } all;
        const auto cell = [](std::size_t i) { return static_cast<CellId>(i); };
        visit_pairs(cell, scene_.cell_count(), cell, scene_.cell_count(), all);
        std::vector<std::pair<CellId, CellId>> pairs;
        for (const auto& some : all.pairs)
            pairs.insert(pairs.end(), some.begin(), some.end());
        oneapi::tbb::parallel_sort(pairs);
        return pairs;
    }

    const Mesh& mesh_;
    const Adjacency& adjacency_;
    const Orientations& orientations_;
    const Scene& scene_;
};

} // namespace

bool interiors_overlap(const Scene& scene, CellId a, CellId b)
{
    const Orientations& orientations = scene.orientations();
    return orientations.sign[a] != 0 && orientations.sign[b] != 0 && solids_overlap(scene.mesh(), a, b);
}

std::vector<std::pair<CellId, CellId>> derive_overlapping_cells(const Scene& scene)
{
    if (scene.is_surface())
        return {};
    return OverlapSearch(scene).run();
}

} // namespace visorder::detail
