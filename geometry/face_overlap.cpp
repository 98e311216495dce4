#include "geometry/face_overlap.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

// A face that is not edge-on spans, from a positional eye, a convex cone with an interior; its facets are the planes of
// sight through its edges. Along a direction the projections are convex polygons, and the same words hold.
//
// Two such cones C and D share no area exactly if a plane through the eye separates them weakly, that is, if the cone
// spanned by C and -D is not all of space. Then that cone, too, has facets, and every facet's plane is such a plane. It
// is spanned by two of the generators: by two corners of C, in which case it is the plane of one of C's edges; by two
// of D; or by one of each. The last kind is needed only for cones that no open half-space holds both of: within one,
// the cones are cut to convex polygons in a plane, and for those the edges' lines are enough.
//
// The nearer of two planes along a ray with direction x is the one with the greater 1 / depth, which is linear in x. So
// over the common cone the sign of the difference is known from its extreme rays: the corners of each cone in the
// other, and the crossings of two edges.

namespace visorder::detail {

namespace {

// Where the rays start or, along a direction, where they come from.
struct Viewpoint {
    glm::dvec4 eye;
    glm::dvec3 position; // exact; NaN if doubles cannot hold it, which sends every question to the exact predicates
    bool parallel;

    explicit Viewpoint(const glm::dvec4& eye_) : eye(eye_), parallel(eye_.w == 0)
    {
        const bool exact = eye.w == 1 || eye.w == -1;
        position = exact ? glm::dvec3(eye) * eye.w : glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    }
};

// A rounded sum of three products of rounded differences, and a bound of its error: Shewchuk's (7 + 56 u) u times the
// permanent (1997, section 4.3), rounded up to 9 u, and more than what underflow can add. Overflow makes one of the two
// infinite or NaN, and then nothing is certain.
struct Estimate {
    double value;
    double bound;

    bool certain() const { return std::abs(value) > bound; }
    Sign sign() const { return value > 0 ? Sign::positive : Sign::negative; }
};

// glm::abs branches.
glm::dvec3 absolute(const glm::dvec3& v)
{
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

Estimate estimate(const glm::dvec3& normal, const glm::dvec3& permanent, const glm::dvec3& v)
{
    const glm::dvec3 size = absolute(v);
    return {normal.x * v.x + normal.y * v.y + normal.z * v.z,
            1e-15 * (permanent.x * size.x + permanent.y * size.y + permanent.z * size.z) +
                1e-300 * (1 + size.x + size.y + size.z)};
}

// The plane through the eye and two points, asked for the sides of many others.
class SightPlane {
public:
    SightPlane(const Viewpoint& from, const glm::dvec3& a, const glm::dvec3& b)
        : from_(from), a_(a), b_(b), base_(from.parallel ? a : from.position)
    {
        const glm::dvec3 p = from.parallel ? glm::dvec3(from.eye) : b - base_;
        const glm::dvec3 q = from.parallel ? b - a : a - base_;
        const double x1 = p.y * q.z, x2 = p.z * q.y;
        const double y1 = p.z * q.x, y2 = p.x * q.z;
        const double z1 = p.x * q.y, z2 = p.y * q.x;
        normal_ = {x1 - x2, y1 - y2, z1 - z2};
        permanent_ = {std::abs(x1) + std::abs(x2), std::abs(y1) + std::abs(y2), std::abs(z1) + std::abs(z2)};
    }

    // side_of_plane(a, b, x, eye).
    Sign side(const glm::dvec3& x) const
    {
        const Estimate filtered = estimate(normal_, permanent_, x - base_);
        if (filtered.certain()) [[likely]]
            return filtered.sign();
        // Faces that meet share vertices; exact arithmetic need not find that out.
        if (x == a_ || x == b_)
            return Sign::zero;
        return side_of_plane(a_, b_, x, from_.eye);
    }

    // Proportional to the distance of x, rounded.
    double distance(const glm::dvec3& x) const { return glm::dot(normal_, x - base_); }

private:
    const Viewpoint& from_;
    const glm::dvec3& a_;
    const glm::dvec3& b_;
    glm::dvec3 base_;
    glm::dvec3 normal_;
    glm::dvec3 permanent_;
};

std::size_t at(int i)
{
    return static_cast<std::size_t>(i);
}

const glm::dvec3& corner(const SeenFace& face, int i)
{
    return face.points[at(i == face.count ? 0 : i)];
}

SightPlane edge_plane(const Viewpoint& from, const SeenFace& face, int edge)
{
    return {from, corner(face, edge), corner(face, edge + 1)};
}

// Whether the plane of sight through an edge of `face` has all of `other` weakly on its outer side.
bool edge_separates(const Viewpoint& from, const SeenFace& face, const SeenFace& other)
{
    for (int edge = 0; edge < face.count; ++edge) {
        const SightPlane plane = edge_plane(from, face, edge);
        bool outside = true;
        for (int i = 0; outside && i < other.count; ++i)
            outside = plane.side(other.points[at(i)]) != face.turn;
        if (outside)
            return true;
    }
    return false;
}

// A sufficient test: whether all corners lie certainly in front of a plane through the eye, halfway between the two
// faces' directions.
bool in_one_half_space(const Viewpoint& from, const SeenFace& f, const SeenFace& g)
{
    const auto direction = [&](const SeenFace& face) {
        glm::dvec3 sum(0);
        for (int i = 0; i < face.count; ++i)
            sum += face.points[at(i)] - from.position;
        return sum / (std::abs(sum.x) + std::abs(sum.y) + std::abs(sum.z));
    };
    const glm::dvec3 axis = direction(f) + direction(g);
    for (const SeenFace* face : {&f, &g})
        for (int i = 0; i < face->count; ++i) {
            const Estimate height = estimate(axis, absolute(axis), face->points[at(i)] - from.position);
            if (!(height.certain() && height.sign() == Sign::positive))
                return false;
        }
    return true;
}

// Whether a plane of sight through one corner of each face separates the two weakly.
bool corner_plane_separates(const Viewpoint& from, const SeenFace& f, const SeenFace& g)
{
    for (int i = 0; i < f.count; ++i)
        for (int j = 0; j < g.count; ++j) {
            const SightPlane plane(from, f.points[at(i)], g.points[at(j)]);
            // A true plane cannot hold all of a cone; where eye and both corners are collinear it seems to.
            Sign side = Sign::zero;
            bool separates = true;
            for (int k = 0; separates && k < f.count; ++k) {
                const Sign s = k == i ? Sign::zero : plane.side(f.points[at(k)]);
                separates = s == Sign::zero || s != -side;
                if (s != Sign::zero)
                    side = s;
            }
            for (int k = 0; separates && k < g.count; ++k)
                separates = k == j || plane.side(g.points[at(k)]) != side;
            if (separates && side != Sign::zero)
                return true;
        }
    return false;
}

bool share_no_area(const Viewpoint& from, const SeenFace& f, const SeenFace& g)
{
    if (edge_separates(from, g, f) || edge_separates(from, f, g))
        return true;
    return !from.parallel && !in_one_half_space(from, f, g) && corner_plane_separates(from, f, g);
}

// For the points of one face, on which side of another's plane they lie: positive on the eye's.
struct PlaneSides {
    std::array<Sign, 4> of{};
    bool some_near = false;
    bool some_far = false;
};

PlaneSides plane_sides(const SeenFace& plane, const SeenFace& points)
{
    PlaneSides sides;
    for (int i = 0; i < points.count; ++i) {
        const glm::dvec3& x = points.points[at(i)];
        const glm::dvec3* end = plane.points.data() + plane.count;
        const bool shared = std::find(plane.points.data(), end, x) != end;
        const Sign s =
            shared ? Sign::zero : side_of_plane(plane.points[0], plane.points[1], plane.points[2], x) * plane.turn;
        sides.of[at(i)] = s;
        sides.some_near |= s == Sign::positive;
        sides.some_far |= s == Sign::negative;
    }
    return sides;
}

// Whether all corners of `points` lie for sure on the side of a face's plane that `side` says, some strictly:
// `positive` is the eye's. Corners in common lie in the plane.
bool all_surely_on(Sign side, const SeenFace& plane, const SeenFace& points)
{
    const glm::dvec3 &a = plane.points[0], p = plane.points[1] - a, q = plane.points[2] - a;
    const double x1 = p.y * q.z, x2 = p.z * q.y;
    const double y1 = p.z * q.x, y2 = p.x * q.z;
    const double z1 = p.x * q.y, z2 = p.y * q.x;
    const glm::dvec3 normal(x1 - x2, y1 - y2, z1 - z2);
    const glm::dvec3 permanent(std::abs(x1) + std::abs(x2), std::abs(y1) + std::abs(y2), std::abs(z1) + std::abs(z2));
    const Sign wanted = side * plane.turn;
    bool some = false;
    for (int i = 0; i < points.count; ++i) {
        const glm::dvec3& x = points.points[at(i)];
        const Estimate height = estimate(normal, permanent, x - a);
        if (height.certain()) {
            if (height.sign() != wanted)
                return false;
            some = true;
        } else if (std::find(plane.points.data(), plane.points.data() + plane.count, x) ==
                   plane.points.data() + plane.count) {
            return false;
        }
    }
    return some;
}

// Of every corner of one face at every edge of another: positive inside, negative outside the other's cone.
struct ConeSides {
    std::array<std::array<Sign, 4>, 4> of; // [edge][corner]

    ConeSides(const Viewpoint& from, const SeenFace& edges, const SeenFace& corners) : edges_(edges.count)
    {
        for (int e = 0; e < edges.count; ++e) {
            const SightPlane plane = edge_plane(from, edges, e);
            for (int i = 0; i < corners.count; ++i)
                of[at(e)][at(i)] = plane.side(corners.points[at(i)]) * edges.turn;
        }
    }

    bool contains(int i) const
    {
        return std::none_of(of.begin(), of.begin() + edges_,
                            [&](const auto& edge) { return edge[at(i)] == Sign::negative; });
    }

private:
    int edges_;
};

// The extreme rays of the common cone of two overlapping faces.
class CommonCone {
public:
    CommonCone(const Viewpoint& from, const SeenFace& f, const SeenFace& g)
        : f_(f), g_(g), f_at_g_(from, g, f), g_at_f_(from, f, g)
    {
    }

    // Calls for each corner i of F in the cone of G, each corner j of G in the cone of F, and each edge i of F and edge
    // j of G that cross in inner points; until one returns true.
    template <class CornerOfF, class CornerOfG, class Crossing>
    void visit(CornerOfF&& corner_of_f, CornerOfG&& corner_of_g, Crossing&& crossing) const
    {
        for (int i = 0; i < f_.count; ++i)
            if (f_at_g_.contains(i) && corner_of_f(i))
                return;
        for (int j = 0; j < g_.count; ++j)
            if (g_at_f_.contains(j) && corner_of_g(j))
                return;
        for (int i = 0; i < f_.count; ++i)
            for (int j = 0; j < g_.count; ++j)
                if (edges_cross(i, j) && crossing(i, j))
                    return;
    }

private:
    // With p, q the ends of F's edge and r, s those of G's, the planes of sight meet in the line along
    // (p x q) x (r x s) = det(p, q, s) r - det(p, q, r) s = det(r, s, p) q - det(r, s, q) p,
    // which one ray of each wedge follows, and the same one, if the signs are as here or all reversed.
    bool edges_cross(int i, int j) const
    {
        const auto& at_f = g_at_f_.of[at(i)];
        const auto& at_g = f_at_g_.of[at(j)];
        const Sign r = at_f[at(j)] * f_.turn, s = at_f[at(j + 1 == g_.count ? 0 : j + 1)] * f_.turn;
        const Sign p = at_g[at(i)] * g_.turn, q = at_g[at(i + 1 == f_.count ? 0 : i + 1)] * g_.turn;
        return s != Sign::zero && r == -s && p == s && q == -s;
    }

    const SeenFace& f_;
    const SeenFace& g_;
    ConeSides f_at_g_;
    ConeSides g_at_f_;
};

Overlap compare_at_extreme_rays(const Viewpoint& from, const SeenFace& f, const SeenFace& g, const PlaneSides& f_at_g,
                                const PlaneSides& g_at_f)
{
    bool nearer = false, farther = false;
    const auto take = [&](Sign s) {
        nearer |= s == Sign::positive;
        farther |= s == Sign::negative;
        return nearer && farther;
    };
    CommonCone(from, f, g)
        .visit([&](int i) { return take(f_at_g.of[at(i)]); }, [&](int j) { return take(-g_at_f.of[at(j)]); },
               [&](int i, int j) {
                   const glm::dvec3 &p = corner(f, i), &q = corner(f, i + 1);
                   const glm::dvec3 &r = corner(g, j), &s = corner(g, j + 1);
                   // The tetrahedron p q r s turns with the order of the two edges along the ray.
                   return take(side_of_plane(p, q, r, s) * side_of_plane(p, q, s, from.eye));
               });
    if (nearer && farther)
        return Overlap::crossing;
    return nearer ? Overlap::nearer : farther ? Overlap::farther : Overlap::coincident;
}

// The point of the face's plane on the ray through x, rounded.
glm::dvec3 shadow(const Viewpoint& from, const glm::dvec3& x, const SeenFace& face)
{
    const glm::dvec3 origin = face.points[0];
    const glm::dvec3 normal = glm::cross(face.points[1] - origin, face.points[2] - origin);
    const glm::dvec3 ray = from.parallel ? glm::dvec3(from.eye) : x - from.position;
    return x - ray * (glm::dot(normal, x - origin) / glm::dot(normal, ray));
}

} // namespace

SeenFace seen_face(std::span<const glm::dvec3> face, const glm::dvec4& eye)
{
    SeenFace seen;
    for (const glm::dvec3& point : face) {
        const glm::dvec3* end = seen.points.data() + seen.count;
        if (std::find(std::as_const(seen.points).data(), end, point) == end)
            seen.points[at(seen.count++)] = point;
    }
    // Of four distinct corners three in a row may be collinear, but then no other three are.
    for (int start = 0; seen.count >= 3 && start < seen.count - 2; ++start) {
        seen.turn = side_of_plane(seen.points[0], seen.points[1], seen.points[2], eye);
        if (seen.turn != Sign::zero)
            break;
        std::rotate(seen.points.begin(), seen.points.begin() + 1, seen.points.begin() + seen.count);
    }
    return seen;
}

Overlap face_overlap(const SeenFace& f, const SeenFace& g, const glm::dvec4& eye)
{
    if (f.turn == Sign::zero || g.turn == Sign::zero)
        return Overlap::disjoint;
    return share_no_area(Viewpoint(eye), f, g) ? Overlap::disjoint : depth_overlap(f, g, eye);
}

Overlap depth_overlap(const SeenFace& f, const SeenFace& g, const glm::dvec4& eye)
{
    const PlaneSides f_at_g = plane_sides(g, f);
    if (!f_at_g.some_near && !f_at_g.some_far)
        return Overlap::coincident;
    if (!f_at_g.some_far)
        return Overlap::nearer;
    if (!f_at_g.some_near)
        return Overlap::farther;
    const PlaneSides g_at_f = plane_sides(f, g);
    if (!g_at_f.some_near)
        return Overlap::nearer;
    if (!g_at_f.some_far)
        return Overlap::farther;
    return compare_at_extreme_rays(Viewpoint(eye), f, g, f_at_g, g_at_f);
}

bool surely_not_nearer(const SeenFace& f, const SeenFace& g)
{
    return all_surely_on(Sign::positive, f, g) || all_surely_on(Sign::negative, g, f);
}

Overlap face_overlap(std::span<const glm::dvec3> f, std::span<const glm::dvec3> g, const glm::dvec4& eye)
{
    return face_overlap(seen_face(f, eye), seen_face(g, eye), eye);
}

glm::dvec3 common_point(const SeenFace& f, const SeenFace& g, const glm::dvec4& eye)
{
    Viewpoint from(eye);
    const CommonCone cone(from, f, g); // before the position is rounded: its signs are to be exact
    Viewpoint rounded = from;
    if (!from.parallel)
        rounded.position = glm::dvec3(eye) / eye.w;
    glm::dvec3 sum(0);
    int corners = 0;
    const auto take = [&](const glm::dvec3& x) {
        sum += x;
        ++corners;
        return false;
    };
    cone.visit([&](int i) { return take(shadow(rounded, f.points[at(i)], g)); },
               [&](int j) { return take(g.points[at(j)]); },
               [&](int i, int j) {
                   const SightPlane plane = edge_plane(rounded, f, i);
                   const glm::dvec3 &r = corner(g, j), &s = corner(g, j + 1);
                   const double to_r = std::abs(plane.distance(r)), to_s = std::abs(plane.distance(s));
                   return take(to_r + to_s > 0 ? r + (s - r) * (to_r / (to_r + to_s)) : r);
               });
    return corners > 0 ? sum / static_cast<double>(corners) : g.points[0];
}

} // namespace visorder::detail
