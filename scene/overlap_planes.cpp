#include "scene/overlap_planes.h"

#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <span>

namespace visorder::detail {

namespace {

// The vertices of the two cells, relative to the first one and in units of their extent.
struct Pair {
    std::array<PointId, 2 * max_cell_vertices> ids{};
    std::array<glm::dvec3, 2 * max_cell_vertices> points{};
    std::size_t split = 0; // where the second cell's begin
    std::size_t count = 0;
};

Pair pair_of(const Mesh& mesh, CellId a, CellId b)
{
    Pair pair;
    for (const CellId cell : {a, b}) {
        pair.split = pair.count;
        for (const PointId v : mesh.cell(cell))
            pair.ids[pair.count++] = v;
    }
    const glm::dvec3 origin = mesh.points[pair.ids[0]];
    double extent = 0;
    for (std::size_t i = 0; i < pair.count; ++i) {
        const glm::dvec3 d = mesh.points[pair.ids[i]] * 0.5 - origin * 0.5;
        extent = std::max({extent, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    }
    const int exponent = extent > 0 ? -std::ilogb(extent) : 0;
    for (std::size_t i = 0; i < pair.count; ++i) {
        const glm::dvec3 d = mesh.points[pair.ids[i]] * 0.5 - origin * 0.5;
        pair.points[i] = {std::ldexp(d.x, exponent), std::ldexp(d.y, exponent), std::ldexp(d.z, exponent)};
    }
    return pair;
}

class Deepest {
public:
    explicit Deepest(const Pair& pair) : pair_(pair) {}

    // Tries the plane through three vertices.
    void offer(std::size_t i, std::size_t j, std::size_t k)
    {
        const glm::dvec3 p = pair_.points[j] - pair_.points[i], q = pair_.points[k] - pair_.points[i];
        const glm::dvec3 normal = glm::cross(p, q);
        const double length = glm::length(normal);
        // Points that are nearly collinear say too little of a plane.
        if (!(length > 1e-9 * glm::length(p) * glm::length(q)))
            return;
        double least_a = 0, most_a = 0, least_b = 0, most_b = 0;
        for (std::size_t v = 0; v < pair_.count; ++v) {
            const double height = glm::dot(normal, pair_.points[v] - pair_.points[i]) / length;
            double& least = v < pair_.split ? least_a : least_b;
            double& most = v < pair_.split ? most_a : most_b;
            least = std::min(least, height);
            most = std::max(most, height);
        }
        take(std::max(most_a, -least_b), {pair_.ids[i], pair_.ids[j], pair_.ids[k]}); // b on the positive side
        take(std::max(most_b, -least_a), {pair_.ids[i], pair_.ids[k], pair_.ids[j]}); // a there: turned round
    }

    double depth() const { return depth_; }
    // The second cell is on the side that sees it counterclockwise.
    const FaceTriple& plane() const { return plane_; }

private:
    void take(double depth, const FaceTriple& plane)
    {
        if (depth < depth_) {
            depth_ = depth;
            plane_ = plane;
        }
    }

    const Pair& pair_;
    double depth_ = std::numeric_limits<double>::infinity();
    FaceTriple plane_{0, 0, 0};
};

// Faces of either cell, and an edge of one with a vertex of the other: what may separate convex bodies that touch (see
// overlapping_cells.cpp). Trying all pairs of vertices spares finding out which are edges.
OverlapPlane plane_between(const Mesh& mesh, CellId a, CellId b)
{
    const Pair pair = pair_of(mesh, a, b);
    Deepest deepest(pair);
    for (std::size_t i = 0; i < pair.count; ++i)
        for (std::size_t j = i + 1; j < pair.count; ++j)
            for (std::size_t k = j + 1; k < pair.count; ++k)
                deepest.offer(i, j, k);
    return {b, a, deepest.plane(), deepest.depth()};
}

} // namespace

std::vector<OverlapPlane> derive_overlap_planes(const Scene& scene)
{
    const auto& pairs = scene.overlapping_cells();
    std::vector<OverlapPlane> planes(pairs.size());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, pairs.size(), 64), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            planes[i] = plane_between(scene.mesh(), pairs[i].first, pairs[i].second);
    });
    std::erase_if(planes, [](const OverlapPlane& plane) { return !std::isfinite(plane.depth); });
    std::stable_sort(planes.begin(), planes.end(),
                     [](const OverlapPlane& a, const OverlapPlane& b) { return a.depth < b.depth; });
    return planes;
}

} // namespace visorder::detail
