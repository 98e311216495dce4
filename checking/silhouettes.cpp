#include "checking/silhouettes.h"

#include "scene/adjacency.h"
#include "scene/boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <tuple>
#include <utility>

namespace visorder::detail {

namespace {

struct FacedEdge {
    PointId low, high;
    int facing; // of the face that it is an edge of: 1 towards the eye, -1 away from it, 0 edge-on

    bool operator<(const FacedEdge& other) const
    {
        return std::tie(low, high, facing) < std::tie(other.low, other.high, other.facing);
    }
};

int facing(const std::array<glm::dvec3, 3>& face, const glm::dvec3& opposite, const glm::dvec4& eye)
{
    const glm::dvec3 normal = glm::cross(face[1] - face[0], face[2] - face[0]);
    const glm::dvec3 to_eye = eye.w == 0 ? glm::dvec3(eye) : glm::dvec3(eye) / eye.w - face[0];
    const double sides = glm::dot(normal, to_eye) * glm::dot(normal, opposite - face[0]);
    return (sides < 0) - (sides > 0);
}

// The edges of all boundary faces, those of the same two points side by side.
std::vector<FacedEdge> boundary_edges(const Scene& scene, const glm::dvec4& eye)
{
    const Mesh& mesh = scene.mesh();
    std::vector<FacedEdge> edges;
    edges.reserve(scene.boundary().faces.size() * 3);
    for (const CellFace& face : scene.boundary().faces) {
        const auto cell = mesh.cell(face.cell);
        const auto local = face_vertices(CellShape::tetrahedron, static_cast<int>(face.face));
        const std::array<PointId, 3> v = {cell[local[0]], cell[local[1]], cell[local[2]]};
        const std::size_t opposite = std::size_t{6} - local[0] - local[1] - local[2];
        const int faces =
            facing({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]}, mesh.points[cell[opposite]], eye);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(v[i], v[(i + 1) % 3]);
            edges.push_back({low, high, faces});
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

struct Segment {
    glm::dvec2 a, b;
};

// The part of an edge before the eye that is at most `margin` outside the image, in pixels.
std::optional<Segment> in_image(const PixelRays& rays, const SeenPoint& a, const SeenPoint& b, glm::ivec2 size,
                                double margin)
{
    // Offsets from the four planes through the eye and the image's sides, moved outwards by the margin; positive
    // inside.
    const auto offsets = [&](const SeenPoint& p) {
        return std::array{p.x + margin * p.w + rays.x_constant(-margin),
                          -(p.x - (size.x + margin) * p.w + rays.x_constant(size.x + margin)),
                          p.y + margin * p.w + rays.y_constant(-margin),
                          -(p.y - (size.y + margin) * p.w + rays.y_constant(size.y + margin))};
    };
    const auto of_a = offsets(a);
    const auto of_b = offsets(b);
    double begin = 0, end = 1;
    for (std::size_t i = 0; i < of_a.size(); ++i) {
        if (of_a[i] < 0 && of_b[i] < 0)
            return std::nullopt;
        const double crossing = of_a[i] / (of_a[i] - of_b[i]);
        if (of_a[i] < 0)
            begin = std::max(begin, crossing);
        else if (of_b[i] < 0)
            end = std::min(end, crossing);
    }
    const auto point = [&](double t) {
        return SeenPoint{std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t), std::lerp(a.w, b.w, t), 0};
    };
    const SeenPoint first = point(begin), last = point(end);
    if (begin > end || rays.w(first) <= 0 || rays.w(last) <= 0)
        return std::nullopt;
    return Segment{rays.pixel(first), rays.pixel(last)};
}

double distance(const glm::dvec2& p, const Segment& segment)
{
    const glm::dvec2 along = segment.b - segment.a;
    const double length_2 = glm::dot(along, along);
    const double t = length_2 == 0 ? 0 : std::clamp(glm::dot(p - segment.a, along) / length_2, 0.0, 1.0);
    return glm::length(p - (segment.a + t * along));
}

// The pixels, from `first` up to `last`, whose centres are between two coordinates.
std::pair<int, int> centres_between(double low, double high, int count)
{
    return {static_cast<int>(std::ceil(std::clamp(low - 0.5, 0.0, count * 1.0))),
            static_cast<int>(std::floor(std::clamp(high - 0.5, -1.0, count - 1.0))) + 1};
}

void mark(std::vector<std::uint8_t>& marks, glm::ivec2 size, const Segment& segment, double margin)
{
    const glm::dvec2& a = segment.a;
    const glm::dvec2& b = segment.b;
    const auto [bottom, top] = centres_between(std::min(a.y, b.y) - margin, std::max(a.y, b.y) + margin, size.y);
    for (int y = bottom; y < top; ++y) {
        // Where along the segment its points are at most the margin above or below the row.
        double begin = 0, end = 1;
        if (a.y != b.y) {
            const double t = (y + 0.5 - margin - a.y) / (b.y - a.y);
            const double u = (y + 0.5 + margin - a.y) / (b.y - a.y);
            begin = std::clamp(std::min(t, u), 0.0, 1.0);
            end = std::clamp(std::max(t, u), 0.0, 1.0);
        }
        const double x = std::lerp(a.x, b.x, begin);
        const double x2 = std::lerp(a.x, b.x, end);
        const auto [left, right] = centres_between(std::min(x, x2) - margin, std::max(x, x2) + margin, size.x);
        for (int column = left; column < right; ++column)
            if (distance({column + 0.5, y + 0.5}, segment) <= margin)
                marks[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(column)] = 1;
    }
}

} // namespace

std::vector<std::uint8_t> silhouette_pixels(const Scene& scene, const View& view, const PixelRays& rays, double margin)
{
    std::vector<std::uint8_t> marks(static_cast<std::size_t>(view.size.x) * static_cast<std::size_t>(view.size.y), 0);
    const std::vector<FacedEdge> edges = boundary_edges(scene, view.eye);
    for (auto edge = edges.begin(); edge != edges.end();) {
        const auto next = std::find_if(edge, edges.end(), [&](const FacedEdge& other) {
            return other.low != edge->low || other.high != edge->high;
        });
        if (edge->facing == 0 || edge->facing != (next - 1)->facing) {
            const SeenPoint low = rays.seen(scene.mesh().points[edge->low]);
            const SeenPoint high = rays.seen(scene.mesh().points[edge->high]);
            if (const auto segment = in_image(rays, low, high, view.size, margin))
                mark(marks, view.size, *segment, margin);
        }
        edge = next;
    }
    return marks;
}

} // namespace visorder::detail
