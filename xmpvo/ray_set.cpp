#include "xmpvo/ray_set.h"

#include "geometry/box_hierarchy.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <vector>

namespace visorder::detail {

namespace {

constexpr double pulled_in = 1.0 / 1024; // of the way from a corner to the centre
constexpr double beside = 1.0 / 1024;    // a crossing, of the shorter edge's length
constexpr double least_beside = 0x1p-19; // a few roundings of single precision
constexpr double nearly_parallel = 1e-9; // the sine of their angle: no telling where such edges cross
constexpr double far_off = 2;            // distance of an eye that has all of the scene in front of it

template <class Body>
void in_parallel(std::size_t count, std::size_t grain, const Body& body)
{
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            body(i);
    });
}

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

// A projection to a plane, in which edges are straight: the image of x is (right.d, up.d) / depth(x), with d = x -
// from. An eye far off, or at infinity, needs one. Dividing by its distance to the middle of the scene keeps the depth
// near 1 and rounds nothing away. An eye in or near the scene needs six, the sides of a cube around it.
class Chart {
public:
    static std::vector<Chart> around(const glm::dvec4& eye)
    {
        const glm::dvec3 position(eye);
        const double distance = glm::length(position);
        if (distance > far_off * eye.w)
            return {Chart(-position / distance, glm::dvec3(0), 1, eye.w / distance, false)};
        std::vector<Chart> charts;
        for (const double sign : {1.0, -1.0})
            for (const glm::dvec3& axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
                charts.push_back(Chart(sign * axis, position / eye.w, 0, 1, true));
        return charts;
    }

    struct Segment {
        glm::dvec3 a, b; // in space
        double depth_a, depth_b;
        glm::dvec2 image_a, image_b;
        std::uint32_t point_a, point_b; // ends of the whole edge
    };

    // The part of an edge that the chart shows.
    std::optional<Segment> segment(const BoundarySurface& surface, const BoundarySurface::Edge& edge) const
    {
        Segment s{surface.points[edge.a], surface.points[edge.b], 0, 0, {}, {}, edge.a, edge.b};
        if (side_of_cube_ && !cut_to_side(s.a, s.b))
            return std::nullopt;
        s.depth_a = depth(s.a);
        s.depth_b = depth(s.b);
        if (!(std::min(s.depth_a, s.depth_b) > 1e-9))
            return std::nullopt;
        s.image_a = across(s.a) / s.depth_a;
        s.image_b = across(s.b) / s.depth_b;
        return s;
    }

    // The point of a segment at `part` of its image's length, moved by `offset` in the image.
    glm::dvec3 point(const Segment& s, double part, const glm::dvec2& offset) const
    {
        const double weight_a = (1 - part) * s.depth_b, weight_b = part * s.depth_a;
        const glm::dvec3 on_edge = s.a + (s.b - s.a) * (weight_b / (weight_a + weight_b));
        return on_edge + (right_ * offset.x + up_ * offset.y) * depth(on_edge);
    }

private:
    Chart(const glm::dvec3& axis, const glm::dvec3& from, double depth_there, double slope, bool side_of_cube)
        : axis_(axis), from_(from), depth_there_(depth_there), slope_(slope), side_of_cube_(side_of_cube)
    {
        const glm::dvec3 size = glm::abs(axis);
        const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                                 : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                      : glm::dvec3(0, 0, 1);
        right_ = glm::normalize(glm::cross(least, axis));
        up_ = glm::cross(axis, right_);
    }

    glm::dvec2 across(const glm::dvec3& x) const { return {glm::dot(right_, x - from_), glm::dot(up_, x - from_)}; }
    double depth(const glm::dvec3& x) const { return depth_there_ + slope_ * glm::dot(axis_, x - from_); }

    // Cuts a segment to where neither coordinate across is above the depth; false if nothing is left.
    bool cut_to_side(glm::dvec3& a, glm::dvec3& b) const
    {
        double begin = 0, end = 1;
        const glm::dvec2 at_a = across(a), at_b = across(b);
        const double depth_a = depth(a), depth_b = depth(b);
        for (glm::length_t k = 0; k < 2; ++k)
            for (const double sign : {1.0, -1.0}) {
                const double from = depth_a - sign * at_a[k], to = depth_b - sign * at_b[k];
                if (from < 0 && to < 0)
                    return false;
                if (from < 0)
                    begin = std::max(begin, from / (from - to));
                else if (to < 0)
                    end = std::min(end, from / (from - to));
            }
        if (begin >= end)
            return false;
        const glm::dvec3 whole = b - a;
        b = a + whole * end;
        a += whole * begin;
        return true;
    }

    glm::dvec3 axis_, right_, up_, from_;
    double depth_there_; // at `from`
    double slope_;       // of the depth along the axis
    bool side_of_cube_;
};

using Segment = Chart::Segment;

// Where the images of two segments cross.
struct Crossing {
    double part_of_s;
    glm::dvec2 between, other; // offsets into the sectors
};

std::optional<Crossing> crossing_of(const Segment& s, const Segment& t)
{
    if (s.point_a == t.point_a || s.point_a == t.point_b || s.point_b == t.point_a || s.point_b == t.point_b)
        return std::nullopt;
    const glm::dvec2 along_s = s.image_b - s.image_a, along_t = t.image_b - t.image_a;
    const double length_s = glm::length(along_s), length_t = glm::length(along_t);
    const double turn = cross(along_s, along_t);
    if (!(std::abs(turn) > nearly_parallel * length_s * length_t))
        return std::nullopt;
    const double part_of_s = cross(t.image_a - s.image_a, along_t) / turn;
    const double part_of_t = cross(t.image_a - s.image_a, along_s) / turn;
    if (part_of_s < 0 || part_of_s > 1 || part_of_t < 0 || part_of_t > 1)
        return std::nullopt;
    const double distance = std::max(beside * std::min(length_s, length_t), least_beside);
    const glm::dvec2 unit_s = along_s / length_s, unit_t = along_t / length_t;
    return Crossing{part_of_s, glm::normalize(unit_s + unit_t) * distance, glm::normalize(unit_s - unit_t) * distance};
}

// Visits the four points beside a crossing.
void visit_crossing(const Chart& chart, const Segment& s, const Crossing& crossing, const VisitTargets& visit)
{
    const auto& [part, between, other] = crossing;
    visit(std::array{chart.point(s, part, between), chart.point(s, part, other), chart.point(s, part, -between),
                     chart.point(s, part, -other)});
}

constexpr std::size_t most_crossings_per_face = 4;

// Spread evenly over all numbers, whatever the two are.
std::uint64_t scattered(std::uint32_t a, std::uint32_t b)
{
    std::uint64_t h = (std::uint64_t{a} << 32 | b) * 0x9e3779b97f4a7c15u;
    h = (h ^ h >> 32) * 0xd6e8feb86659fd93u;
    return h ^ h >> 32;
}

// The silhouette edges that one chart shows, and what finds those whose images meet.
struct ChartEdges {
    Chart chart;
    std::vector<Segment> segments;
    std::vector<Box> boxes;
    BoxHierarchy hierarchy;

    ChartEdges(const Chart& with, const BoundarySurface& surface, std::span<const std::uint32_t> edges)
        : chart(with), segments(segments_of(with, surface, edges)), boxes(boxes_of(segments)), hierarchy(boxes)
    {
    }

    // Calls found(segment, other segment, crossing), by several threads at once.
    template <class Found>
    void each_crossing(const Found& found) const
    {
        in_parallel(segments.size(), 32, [&](std::size_t i) {
            hierarchy.search([&](const Box& box) { return box.meets(boxes[i]); },
                             [&](std::uint32_t k) {
                                 if (k > i)
                                     if (const auto crossing = crossing_of(segments[i], segments[k]))
                                         found(segments[i], segments[k], *crossing);
                                 return true;
                             });
        });
    }

private:
    static std::vector<Segment> segments_of(const Chart& chart, const BoundarySurface& surface,
                                            std::span<const std::uint32_t> edges)
    {
        std::vector<Segment> segments;
        for (std::uint32_t edge : edges)
            if (const auto segment = chart.segment(surface, surface.edges[edge]))
                segments.push_back(*segment);
        return segments;
    }

    static std::vector<Box> boxes_of(std::span<const Segment> segments)
    {
        std::vector<Box> boxes;
        for (const Segment& segment : segments) {
            Box& box = boxes.emplace_back();
            box.add(glm::dvec3(segment.image_a, 0));
            box.add(glm::dvec3(segment.image_b, 0));
        }
        return boxes;
    }
};

bool on_silhouette(const BoundarySurface& surface, const BoundarySurface::Edge& edge, std::span<const Sign> sides)
{
    const Sign first = sides[surface.edge_faces[edge.begin]];
    if (edge.end - edge.begin == 1)
        return first != Sign::zero;
    return std::any_of(surface.edge_faces.begin() + edge.begin, surface.edge_faces.begin() + edge.end,
                       [&](std::uint32_t face) { return sides[face] != first; });
}

} // namespace

std::optional<Ray> RaysFromEye::through(const glm::dvec3& target) const
{
    const glm::dvec3 away = eye_.w * target - glm::dvec3(eye_);
    const double length = glm::length(away);
    if (!(length > 0))
        return std::nullopt;
    const glm::dvec3 direction = away / length;
    // Unit coordinates are within sqrt(3) of the middle.
    const double back = std::min(length / eye_.w, glm::dot(target, direction) + 2);
    const Ray ray{target - direction * back, direction};
    // Embree takes finite rays alone; from an eye of extreme weight, doubles may hold none. Written so that what is not
    // a number is no ray.
    constexpr double far_from_the_scene = 1e6;
    const bool valid = glm::length(ray.origin) < far_from_the_scene && glm::length(ray.direction) < 2;
    return valid ? std::optional(ray) : std::nullopt;
}

void visit_faces(const BoundarySurface& surface, std::span<const Sign> sides, const VisitTargets& visit)
{
    in_parallel(surface.faces.size(), 64, [&](std::size_t face) {
        if (sides[face] == Sign::zero)
            return;
        const auto corners = surface.corners(face);
        glm::dvec3 centre(0);
        for (std::uint32_t corner : corners)
            centre += surface.points[corner];
        centre /= static_cast<double>(corners.size());
        std::array<glm::dvec3, 5> targets{centre};
        for (std::size_t i = 0; i < corners.size(); ++i)
            targets[i + 1] = surface.points[corners[i]] + (centre - surface.points[corners[i]]) * pulled_in;
        visit(std::span(targets).first(most_rays));
        if (corners.size() == most_rays)
            visit(std::span(targets).subspan(most_rays));
    });
}

SilhouetteCounts visit_crossings(const BoundarySurface& surface, std::span<const Sign> sides, const glm::dvec4& eye,
                                 const VisitTargets& visit)
{
    std::vector<std::uint32_t> edges;
    for (std::uint32_t i = 0; i < surface.edges.size(); ++i)
        if (on_silhouette(surface, surface.edges[i], sides))
            edges.push_back(i);
    std::vector<ChartEdges> charts;
    std::atomic<std::size_t> crossings = 0;
    for (const Chart& chart : Chart::around(eye)) {
        charts.emplace_back(chart, surface, edges);
        charts.back().each_crossing([&](const Segment&, const Segment&, const Crossing&) {
            crossings.fetch_add(1, std::memory_order_relaxed);
        });
    }
    const std::size_t most = most_crossings_per_face * surface.faces.size();
    const double share = static_cast<double>(most) / static_cast<double>(std::max(most, crossings.load()));
    const bool all = crossings <= most;
    const auto below = static_cast<std::uint64_t>(share * 0x1p63);
    std::atomic<std::size_t> visited = 0;
    for (const ChartEdges& chart : charts)
        chart.each_crossing([&](const Segment& s, const Segment& t, const Crossing& crossing) {
            if (!all && scattered(s.point_a ^ s.point_b << 16, t.point_a ^ t.point_b << 16) >> 1 >= below)
                return;
            visited.fetch_add(1, std::memory_order_relaxed);
            visit_crossing(chart.chart, s, crossing, visit);
        });
    return {edges.size(), crossings, visited};
}

} // namespace visorder::detail
