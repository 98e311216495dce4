#include "checking/ray_sequence.h"

#include "geometry/exact_predicates.h"
#include "scene/face_loop.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <optional>

namespace visorder::detail {

namespace {

// A ray is the points q + s d, d = w q - e, with s >= -1 / w from a position e / w, and any s from a direction.

using Interval = CGAL::Interval_nt<false>;
using Rational = CGAL::Exact_rational;

// A face of a cell: three points that span its plane, counterclockwise from outside, and all its points, ascending, by
// which two cells that share it know it.
struct Side {
    PointId a, b, c;
    std::array<PointId, max_face_vertices> points;
};

struct Sides {
    std::array<Side, max_cell_faces> all;
    int count = 0;
};

// None for a cell without volume.
Sides sides_of(const Mesh& mesh, CellId cell)
{
    Sides sides;
    for (int face = 0; face < face_count(mesh.shapes[cell]); ++face) {
        const FaceLoop loop = face_loop(mesh, cell, face);
        if (loop.count < 3)
            continue;
        const auto triple = spanning_triple(mesh, loop);
        if (!triple)
            continue;
        Sign inner = Sign::zero;
        for (PointId v : mesh.cell(cell))
            if (inner == Sign::zero && std::find(loop.begin(), loop.end(), v) == loop.end())
                inner = side_of_plane(mesh.points[triple->a], mesh.points[triple->b], mesh.points[triple->c],
                                      mesh.points[v]);
        if (inner == Sign::zero)
            return {};
        Side& side = sides.all[static_cast<std::size_t>(sides.count++)];
        side = {triple->a, triple->b, triple->c, {}};
        if (inner == Sign::positive)
            std::swap(side.b, side.c);
        side.points.fill(std::numeric_limits<PointId>::max());
        std::copy(loop.begin(), loop.end(), side.points.begin());
        std::sort(side.points.begin(), side.points.end());
    }
    return sides;
}

template <class Number>
struct Vector {
    Number x, y, z;
};

template <class Number>
Vector<Number> exact(const glm::dvec3& v)
{
    return {Number(v.x), Number(v.y), Number(v.z)};
}

template <class Number>
Vector<Number> operator-(const Vector<Number>& a, const Vector<Number>& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Number>
struct Ray {
    Vector<Number> q, d;
    std::optional<Number> first; // s of the eye

    Ray(const glm::dvec3& through, const glm::dvec4& eye) : q(exact<Number>(through))
    {
        const Vector<Number> e = exact<Number>(glm::dvec3(eye));
        const Number w(eye.w);
        d = {q.x * w - e.x, q.y * w - e.y, q.z * w - e.z};
        if (eye.w != 0)
            first = Number(-1) / w;
    }
};

// Where a ray passes a plane: its height over it at q, outwards, and how that changes along d.
template <class Number>
struct Passage {
    Number height, slope;

    Number at() const { return -height / slope; }
};

template <class Number>
Passage<Number> passage(const Mesh& mesh, const Side& side, const Ray<Number>& ray)
{
    const Vector<Number> a = exact<Number>(mesh.points[side.a]);
    // Seen from outside, a, b and c stand counterclockwise, and this points there.
    const Vector<Number> n = cross(exact<Number>(mesh.points[side.b]) - a, exact<Number>(mesh.points[side.c]) - a);
    return {dot(n, ray.q - a), dot(n, ray.d)};
}

template <class Number>
struct Ends {
    Number enter, leave;
};

std::optional<Ends<Rational>> exact_ends_in_solid(const Mesh& mesh, const Sides& sides, const Ray<Rational>& ray)
{
    std::optional<Rational> enter = ray.first, leave;
    for (int i = 0; i < sides.count; ++i) {
        const auto p = passage(mesh, sides.all[static_cast<std::size_t>(i)], ray);
        if (p.slope == 0) {
            if (p.height >= 0)
                return std::nullopt;
            continue;
        }
        Rational at = p.at();
        if (p.slope < 0 && (!enter || at > *enter))
            enter = std::move(at);
        else if (p.slope > 0 && (!leave || at < *leave))
            leave = std::move(at);
    }
    if (!enter || !leave || *enter >= *leave)
        return std::nullopt;
    return Ends<Rational>{*enter, *leave};
}

constexpr int no_side = -1;

// A cell on the ray, as far as intervals tell.
struct Stretch {
    CellId cell;
    double enter[2], leave[2];                      // bounds of either
    int enter_side = no_side, leave_side = no_side; // where one side alone can be the one
    Sides sides;
    std::optional<Ends<Rational>> ends; // where they were needed
};

enum class Passes { no, yes, unknown };

// In CGAL's rounding mode: nothing here may rest on rounding to nearest.
Passes interval_ends(const Mesh& mesh, const Ray<Interval>& ray, Stretch& stretch)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double enter[2] = {-infinity, -infinity}, leave[2] = {infinity, infinity};
    if (ray.first) {
        enter[0] = ray.first->inf();
        enter[1] = ray.first->sup();
    }
    for (int i = 0; i < stretch.sides.count; ++i) {
        const auto p = passage(mesh, stretch.sides.all[static_cast<std::size_t>(i)], ray);
        if (p.slope.inf() == 0 && p.slope.sup() == 0) {
            if (p.height.inf() >= 0)
                return Passes::no;
            if (!(p.height.sup() < 0))
                return Passes::unknown;
            continue;
        }
        if (!(p.slope.sup() < 0) && !(p.slope.inf() > 0))
            return Passes::unknown;
        const Interval at = p.at();
        if (!std::isfinite(at.inf()) || !std::isfinite(at.sup()))
            return Passes::unknown;
        if (p.slope.sup() < 0) {
            stretch.enter_side = at.inf() > enter[1] ? i : at.sup() < enter[0] ? stretch.enter_side : no_side;
            enter[0] = std::max(enter[0], at.inf());
            enter[1] = std::max(enter[1], at.sup());
        } else {
            stretch.leave_side = at.sup() < leave[0] ? i : at.inf() > leave[1] ? stretch.leave_side : no_side;
            leave[0] = std::min(leave[0], at.inf());
            leave[1] = std::min(leave[1], at.sup());
        }
        if (enter[0] >= leave[1])
            return Passes::no;
    }
    std::copy_n(enter, 2, stretch.enter);
    std::copy_n(leave, 2, stretch.leave);
    return enter[1] < leave[0] ? Passes::yes : Passes::unknown;
}

// The ray through `through` passes a triangle's interior if it passes its three edges on one side. It may do so behind
// the eye.
bool line_passes_triangle(const Mesh& mesh, CellId cell, const glm::dvec3& through, const glm::dvec4& eye)
{
    const auto v = mesh.cell(cell);
    const auto side = [&](std::size_t i, std::size_t j) {
        return side_of_plane(through, mesh.points[v[i]], mesh.points[v[j]], eye);
    };
    const Sign first = side(0, 1);
    return first != Sign::zero && side(1, 2) == first && side(2, 0) == first &&
           side_of_plane(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], eye) != Sign::zero;
}

Sides plane_of_triangle(const Mesh& mesh, CellId cell)
{
    const auto v = mesh.cell(cell);
    Sides sides;
    sides.count = 1;
    sides.all[0] = {v[0], v[1], v[2], {}};
    return sides;
}

// The boxes of a hierarchy that a ray may pass, conservatively: each is widened by what rounding does to the ray
// within the scene.
class BoxesOnRay {
public:
    BoxesOnRay(const glm::dvec3& through, const glm::dvec4& eye, const Box& bounds) : q_(through)
    {
        const glm::dvec3 e(eye), qw = through * eye.w;
        d_ = qw - e;
        const glm::dvec3 error = 4e-16 * (eye.w == 1 ? glm::abs(d_) : glm::abs(qw) + glm::abs(e)) + 1e-300;
        const double longest = std::max({std::abs(d_.x), std::abs(d_.y), std::abs(d_.z)});
        const glm::dvec3 reach = glm::max(glm::abs(bounds.min - q_), glm::abs(bounds.max - q_));
        // As far as the ray is within the scene, |s| is at most this.
        const double s = std::max({reach.x, reach.y, reach.z}) / longest * 1.001;
        margin_ = s * error + 4e-15 * (reach + glm::max(glm::abs(bounds.min), glm::abs(bounds.max))) + 1e-300;
        if (eye.w != 0)
            first_ = -1 / eye.w * (1 + 1e-12);
        for (int c = 0; c < 3; ++c)
            trusted_[c] = std::abs(d_[c]) > 4 * error[c];
        decides_ = std::isfinite(margin_.x + margin_.y + margin_.z);
    }

    bool operator()(const Box& box) const
    {
        if (!decides_)
            return true;
        double low = first_, high = std::numeric_limits<double>::infinity();
        for (int c = 0; c < 3; ++c) {
            const double below = box.min[c] - margin_[c] - q_[c], above = box.max[c] + margin_[c] - q_[c];
            if (!trusted_[c]) {
                // Within the scene, this coordinate changes by no more than a few margins.
                if (below > margin_[c] * 4 || above < -margin_[c] * 4)
                    return false;
                continue;
            }
            const double a = below / d_[c], b = above / d_[c];
            low = std::fmax(low, std::fmin(a, b));
            high = std::fmin(high, std::fmax(a, b));
        }
        return !(low > high);
    }

private:
    glm::dvec3 q_, d_, margin_;
    double first_ = -std::numeric_limits<double>::infinity();
    bool trusted_[3];
    bool decides_;
};

std::vector<Box> boxes_of(const Mesh& mesh)
{
    std::vector<Box> boxes(mesh.cell_count());
    for (CellId cell = 0; cell < boxes.size(); ++cell)
        for (PointId v : mesh.cell(cell))
            boxes[cell].add(mesh.points[v]);
    return boxes;
}

// One ray's way through a scene.
class Trace {
public:
    Trace(const Scene& scene, const glm::dvec4& eye, const glm::dvec3& through)
        : mesh_(scene.mesh()), surface_(scene.is_surface()), eye_(eye), through_(through)
    {
    }

    void add_candidate(CellId cell)
    {
        Stretch stretch{};
        stretch.cell = cell;
        if (!surface_)
            stretch.sides = sides_of(mesh_, cell);
        else if (line_passes_triangle(mesh_, cell, through_, eye_))
            stretch.sides = plane_of_triangle(mesh_, cell);
        if (stretch.sides.count > 0)
            stretches_.push_back(std::move(stretch));
    }

    // Throws out the candidates that the ray does not pass through.
    void pass()
    {
        std::vector<Passes> passes(stretches_.size());
        {
            const Interval::Protector upward;
            const Ray<Interval> ray(through_, eye_);
            for (std::size_t i = 0; i < stretches_.size(); ++i)
                passes[i] = surface_ ? interval_hit(ray, stretches_[i]) : interval_ends(mesh_, ray, stretches_[i]);
        }
        std::size_t kept = 0;
        for (std::size_t i = 0; i < stretches_.size(); ++i) {
            if (passes[i] == Passes::unknown)
                passes[i] = exact_ends(stretches_[i]) ? Passes::yes : Passes::no;
            if (passes[i] != Passes::yes)
                continue;
            if (kept != i)
                stretches_[kept] = std::move(stretches_[i]);
            ++kept;
        }
        stretches_.resize(kept);
    }

    void sequence(RaySequence& result)
    {
        const std::size_t n = stretches_.size();
        std::vector<std::uint32_t> order(n);
        for (std::uint32_t i = 0; i < n; ++i)
            order[i] = i;
        std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
            if (enters_before(stretches_[i], stretches_[j]))
                return true;
            return !enters_before(stretches_[j], stretches_[i]) && stretches_[i].cell < stretches_[j].cell;
        });
        result.cells.resize(n);
        result.behind.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            result.cells[i] = stretches_[order[i]].cell;
            std::uint32_t j = i + 1;
            while (j < n && !is_behind(stretches_[order[j]], stretches_[order[i]]))
                ++j;
            result.behind[i] = j;
        }
    }

    glm::dvec3 entry()
    {
        const Ray<Rational> ray(through_, eye_);
        if (!exact_ends(stretches_.front()))
            return through_;
        const Rational& s = stretches_.front().ends->enter;
        return {CGAL::to_double(Rational(ray.q.x + s * ray.d.x)), CGAL::to_double(Rational(ray.q.y + s * ray.d.y)),
                CGAL::to_double(Rational(ray.q.z + s * ray.d.z))};
    }

private:
    static Passes interval_hit_at(const Interval& at, const Ray<Interval>& ray, Stretch& stretch)
    {
        if (!std::isfinite(at.inf()) || !std::isfinite(at.sup()))
            return Passes::unknown;
        for (double* end : {stretch.enter, stretch.leave}) {
            end[0] = at.inf();
            end[1] = at.sup();
        }
        if (!ray.first || at.inf() > ray.first->sup())
            return Passes::yes;
        return at.sup() <= ray.first->inf() ? Passes::no : Passes::unknown;
    }

    Passes interval_hit(const Ray<Interval>& ray, Stretch& stretch) const
    {
        const auto p = passage(mesh_, stretch.sides.all[0], ray);
        if (!(p.slope.sup() < 0) && !(p.slope.inf() > 0))
            return Passes::unknown;
        return interval_hit_at(p.at(), ray, stretch);
    }

    // Whether the ray passes; then also where, exactly.
    bool exact_ends(Stretch& stretch) const
    {
        if (stretch.ends)
            return true;
        const Ray<Rational> ray(through_, eye_);
        if (surface_) {
            const Rational at = passage(mesh_, stretch.sides.all[0], ray).at();
            if (ray.first && at <= *ray.first)
                return false;
            stretch.ends = Ends<Rational>{at, at};
        } else {
            stretch.ends = exact_ends_in_solid(mesh_, stretch.sides, ray);
        }
        if (!stretch.ends)
            return false;
        const auto enter = CGAL::to_interval(stretch.ends->enter), leave = CGAL::to_interval(stretch.ends->leave);
        stretch.enter[0] = enter.first, stretch.enter[1] = enter.second;
        stretch.leave[0] = leave.first, stretch.leave[1] = leave.second;
        return true;
    }

    bool enters_before(Stretch& a, Stretch& b) const
    {
        if (a.enter[1] < b.enter[0])
            return true;
        if (a.enter[0] > b.enter[1] || &a == &b)
            return false;
        exact_ends(a);
        exact_ends(b);
        return a.ends->enter < b.ends->enter;
    }

    // Whether the ray enters b where it has left a.
    bool is_behind(Stretch& b, Stretch& a) const
    {
        if (a.leave[1] < b.enter[0])
            return true;
        if (a.leave[0] > b.enter[1])
            return false;
        if (a.leave_side != no_side && b.enter_side != no_side &&
            a.sides.all[static_cast<std::size_t>(a.leave_side)].points ==
                b.sides.all[static_cast<std::size_t>(b.enter_side)].points)
            return true;
        exact_ends(a);
        exact_ends(b);
        return surface_ ? a.ends->leave < b.ends->enter : a.ends->leave <= b.ends->enter;
    }

    const Mesh& mesh_;
    bool surface_;
    glm::dvec4 eye_;
    glm::dvec3 through_;
    std::vector<Stretch> stretches_;
};

} // namespace

RayTracer::RayTracer(const Scene& scene, const glm::dvec4& eye)
    : scene_(scene), eye_(eye.w < 0 ? -eye : eye), hierarchy_(boxes_of(scene.mesh()))
{
}

void RayTracer::trace(const glm::dvec3& through, RaySequence& result) const
{
    result.cells.clear();
    result.behind.clear();
    if (!std::isfinite(through.x) || !std::isfinite(through.y) || !std::isfinite(through.z))
        return;
    Trace trace(scene_, eye_, through);
    hierarchy_.search(BoxesOnRay(through, eye_, scene_.bounds()), [&](CellId cell) {
        trace.add_candidate(cell);
        return true;
    });
    trace.pass();
    trace.sequence(result);
}

glm::dvec3 RayTracer::entry(const glm::dvec3& through, CellId cell) const
{
    Trace trace(scene_, eye_, through);
    trace.add_candidate(cell);
    return trace.entry();
}

} // namespace visorder::detail
