#include "sorting/boundary_relations.h"

#include "scene/box_hierarchy.h"
#include "scene/face_loop.h"
#include "scene/face_overlap.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>
#include <optional>
#include <span>
#include <tuple>

namespace visorder {

namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;
constexpr double infinity = std::numeric_limits<double>::infinity();
// Beyond this, sums and products of a few coordinates might overflow.
constexpr double huge = 1e300;

// Maps of the rays from an eye to a plane, together of all of them. Points on one ray have the same first two
// coordinates in a chart; the third grows along the ray.
class Charts {
public:
    Charts(const Scene& scene, const glm::dvec4& eye) : parallel_(eye.w == 0)
    {
        if (parallel_)
            set_direction(glm::dvec3(eye), scene.bounds());
        else
            set_position(eye);
    }

    int count() const { return parallel_ ? 1 : 6; }

    // A box that holds the image of the part of a face that this chart shows, if there may be any.
    std::optional<Box> box(const SeenFace& face, int chart) const
    {
        return parallel_ ? box_along_direction(face) : box_in_side(face, chart);
    }

private:
    static constexpr double whole_range = std::numeric_limits<double>::max();

    void set_direction(const glm::dvec3& towards, const Box& bounds)
    {
        const glm::dvec3 size = glm::abs(towards);
        const glm::dvec3 back = glm::normalize(towards / std::max({size.x, size.y, size.z}));
        const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                                 : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                      : glm::dvec3(0, 0, 1);
        right_ = glm::normalize(glm::cross(least, back));
        up_ = glm::cross(back, right_);
        away_ = -back;
        origin_ = bounds.middle();
        const glm::dvec3 half = bounds.max * 0.5 - bounds.min * 0.5;
        const double radius = half.x + half.y + half.z;
        // Let two points of the scene lie on one ray, up to 2 radius apart. With axes off the true direction by at most
        // 12 u, the points' images are at most 24 u radius apart; each is computed to within 6 u radius (a rounded
        // difference and a sum of three products). 1e-14 is 90 u.
        margin_ = radius < huge ? 1e-14 * radius : infinity;
    }

    std::optional<Box> box_along_direction(const SeenFace& face) const
    {
        if (margin_ == infinity)
            return Box{glm::dvec3(-whole_range), glm::dvec3(whole_range)};
        Box box;
        for (int i = 0; i < face.count; ++i) {
            const glm::dvec3 d = face.points[static_cast<std::size_t>(i)] - origin_;
            const glm::dvec3 image(glm::dot(right_, d), glm::dot(up_, d), glm::dot(away_, d));
            box.add(image);
        }
        return Box{box.min - margin_, box.max + margin_};
    }

    void set_position(const glm::dvec4& eye)
    {
        origin_ = glm::dvec3(eye) / eye.w;
        const glm::dvec3 size = glm::abs(origin_);
        // Division by 1 or -1 does not round.
        const bool exact = std::abs(eye.w) == 1;
        margin_ = exact ? 0.0 : u * std::max({size.x, size.y, size.z}) + std::numeric_limits<double>::min();
    }

    struct Polygon {
        std::array<glm::dvec3, 8> points; // four corners, and one more for each of four cuts
        int count = 0;
    };

    // What remains where `height`, an affine function, is not negative.
    template <class Height>
    static Polygon cut(const Polygon& polygon, const Height& height)
    {
        Polygon rest;
        const auto push = [&](const glm::dvec3& x) { rest.points[static_cast<std::size_t>(rest.count++)] = x; };
        for (int i = 0; i < polygon.count; ++i) {
            const glm::dvec3& a = polygon.points[static_cast<std::size_t>(i)];
            const glm::dvec3& b = polygon.points[static_cast<std::size_t>(i + 1 == polygon.count ? 0 : i + 1)];
            const double at_a = height(a), at_b = height(b);
            if (at_a >= 0)
                push(a);
            if ((at_a >= 0) != (at_b >= 0))
                push(a + (b - a) * (at_a / (at_a - at_b)));
        }
        return rest;
    }

    // Side `chart` of the cube shows the rays with |a| <= z and |b| <= z, where z is along one of the axes or against
    // it and a and b are along the other two; their image is (a / z, b / z).
    std::optional<Box> box_in_side(const SeenFace& face, int chart) const
    {
        const glm::length_t axis = chart / 2;
        const double towards = chart % 2 == 0 ? 1 : -1;
        Polygon polygon;
        polygon.count = face.count;
        double size = 0;
        for (int i = 0; i < face.count; ++i) {
            const glm::dvec3 d = face.points[static_cast<std::size_t>(i)] - origin_;
            polygon.points[static_cast<std::size_t>(i)] = {d[(axis + 1) % 3], d[(axis + 2) % 3], towards * d[axis]};
            size = std::max({size, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        }
        if (!(size < huge))
            return Box{{-1, -1, 0}, {1, 1, whole_range}};

        // The side is taken a little wider than it is, by far more than the roundings of the corners (u size, and that
        // of the position) and of the cuts (some 16 u size more), so that no part of the face within it is cut off.
        const double wider = 0x1p-30 * size + 4 * margin_;
        for (glm::length_t cross = 0; cross < 2; ++cross)
            for (const double sign : {1.0, -1.0}) {
                const auto height = [&](const glm::dvec3& x) { return x.z + wider - sign * x[cross]; };
                const auto* begin = polygon.points.data();
                const auto* end = begin + polygon.count;
                if (std::any_of(begin, end, [&](const glm::dvec3& x) { return height(x) < 0; }))
                    polygon = cut(polygon, height);
            }
        if (polygon.count == 0)
            return std::nullopt;

        const double error = 32 * u * size + 4 * margin_;
        Box box;
        for (int i = 0; i < polygon.count; ++i) {
            const glm::dvec3& x = polygon.points[static_cast<std::size_t>(i)];
            box.add(glm::dvec3(x.x / x.z, x.y / x.z, x.z));
        }
        const double nearest = box.min.z - error, farthest = box.max.z + error;
        // Too near to the eye for its size: doubles do not say where it is in the image.
        if (!(nearest > 0x1p-20 * size))
            return Box{{-1, -1, 0}, {1, 1, farthest}};
        // With |a| <= (1 + 2^-10) z, errors of both move the quotient by at most 2.001 error / z, and by its rounding.
        const double margin = 4 * error / nearest + 4 * u;
        return Box{{std::max(box.min.x - margin, -1.0), std::max(box.min.y - margin, -1.0), nearest},
                   {std::min(box.max.x + margin, 1.0), std::min(box.max.y + margin, 1.0), farthest}};
    }

    bool parallel_;
    glm::dvec3 origin_;
    glm::dvec3 right_{}, up_{}, away_{};
    double margin_; // along a direction: of every image; around a position: of the position's coordinates
};

struct BoundaryFace {
    SeenFace seen;
    CellFace owner;
};

struct ExitsAndEntries {
    std::vector<BoundaryFace> exits;
    std::vector<BoundaryFace> entries;
};

template <class Body>
void in_parallel(std::size_t count, std::size_t grain, const Body& body)
{
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, grain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            body(i);
    });
}

SeenFace seen(const Scene& scene, const CellFace& face, const glm::dvec4& eye)
{
    const Mesh& mesh = scene.mesh();
    std::array<glm::dvec3, 4> points;
    int count = 0;
    for (PointId v : face_loop(mesh, face.cell, static_cast<int>(face.face)))
        points[static_cast<std::size_t>(count++)] = mesh.points[v];
    return seen_face(std::span(points).first(static_cast<std::size_t>(count)), eye);
}

ExitsAndEntries boundary_of_solids(const Scene& scene, const glm::dvec4& eye)
{
    const std::vector<CellFace>& faces = scene.boundary().faces;
    std::vector<Sign> sides(faces.size());
    in_parallel(faces.size(), 1024, [&](std::size_t i) {
        sides[i] = exact_face_side(scene, faces[i].cell, static_cast<int>(faces[i].face), eye);
    });
    const auto with_side = [&](Sign side) {
        std::vector<BoundaryFace> chosen;
        chosen.reserve(static_cast<std::size_t>(std::count(sides.begin(), sides.end(), side)));
        for (std::size_t i = 0; i < faces.size(); ++i)
            if (sides[i] == side)
                chosen.push_back({{}, faces[i]});
        in_parallel(chosen.size(), 1024, [&](std::size_t i) { chosen[i].seen = seen(scene, chosen[i].owner, eye); });
        return chosen;
    };
    return {with_side(Sign::negative), with_side(Sign::positive)};
}

ExitsAndEntries surface_triangles(const Scene& scene, const glm::dvec4& eye)
{
    const Mesh& mesh = scene.mesh();
    std::vector<BoundaryFace> triangles(scene.cell_count());
    in_parallel(triangles.size(), 1024, [&](std::size_t i) {
        const auto cell = static_cast<CellId>(i);
        const auto v = mesh.cell(cell);
        const std::array<glm::dvec3, 3> points{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
        triangles[i] = {seen_face(points, eye), {cell, 0}};
    });
    std::erase_if(triangles, [](const BoundaryFace& t) { return t.seen.turn == Sign::zero; });
    return {triangles, triangles};
}

// The faces that a chart may show, ascending, and their boxes.
struct ChartFaces {
    std::vector<std::uint32_t> faces;
    std::vector<Box> boxes;
};

ChartFaces faces_in_chart(const std::vector<BoundaryFace>& faces, const Charts& charts, int chart)
{
    constexpr std::size_t block_size = 4096;
    std::vector<ChartFaces> blocks((faces.size() + block_size - 1) / block_size);
    in_parallel(blocks.size(), 1, [&](std::size_t block) {
        const std::size_t end = std::min((block + 1) * block_size, faces.size());
        for (std::size_t i = block * block_size; i < end; ++i)
            if (const auto box = charts.box(faces[i].seen, chart)) {
                blocks[block].faces.push_back(static_cast<std::uint32_t>(i));
                blocks[block].boxes.push_back(*box);
            }
    });
    ChartFaces all;
    for (const ChartFaces& block : blocks) {
        all.faces.insert(all.faces.end(), block.faces.begin(), block.faces.end());
        all.boxes.insert(all.boxes.end(), block.boxes.begin(), block.boxes.end());
    }
    return all;
}

bool share_face(const Adjacency& adjacency, CellId a, CellId b)
{
    const auto row = adjacency.row(a);
    return std::find(row.begin(), row.end(), b) != row.end();
}

// Relations as numbers that ascend as they do, which sort faster.
std::uint64_t packed(CellId front, CellId back)
{
    return std::uint64_t{front} << 32 | back;
}
Relation unpacked(std::uint64_t relation)
{
    return {static_cast<CellId>(relation >> 32), static_cast<CellId>(relation)};
}

struct Found {
    std::vector<std::uint64_t> relations;
    std::vector<std::pair<CellId, CellId>> crossings;
    std::size_t candidates = 0;
};

class Search {
public:
    Search(const Scene& scene, const glm::dvec4& eye)
        : scene_(scene),
          eye_(eye),
          adjacency_(scene.is_surface() ? nullptr : &scene.adjacency()),
          faces_(scene.is_surface() ? surface_triangles(scene, eye) : boundary_of_solids(scene, eye))
    {
    }

    void run()
    {
        const Charts charts(scene_, eye_);
        for (int chart = 0; chart < charts.count(); ++chart) {
            const ChartFaces exits = faces_in_chart(faces_.exits, charts, chart);
            const ChartFaces entries = faces_in_chart(faces_.entries, charts, chart);
            if (exits.faces.empty() || entries.faces.empty())
                continue;
            const BoxHierarchy hierarchy(entries.boxes);
            in_parallel(exits.faces.size(), 64, [&](std::size_t i) {
                Found& found = found_.local();
                const BoundaryFace& f = faces_.exits[exits.faces[i]];
                // A face that is nearer than all of F is not covered by it.
                Box behind = exits.boxes[i];
                behind.max.z = infinity;
                hierarchy.search([&](const Box& box) { return box.meets(behind); },
                                 [&](std::uint32_t k) {
                                     test(f, faces_.entries[entries.faces[k]], found);
                                     return true;
                                 });
            });
        }
    }

    void collect(BoundaryRelations& result)
    {
        std::vector<std::uint64_t> relations;
        result.overlapping = scene_.overlapping_cells();
        result.candidates = 0;
        for (const Found& found : found_) {
            relations.insert(relations.end(), found.relations.begin(), found.relations.end());
            result.overlapping.insert(result.overlapping.end(), found.crossings.begin(), found.crossings.end());
            result.candidates += found.candidates;
        }
        // A pair is found once a chart and once for every two faces.
        oneapi::tbb::parallel_sort(relations);
        relations.erase(std::unique(relations.begin(), relations.end()), relations.end());
        std::vector<std::pair<CellId, CellId>>& overlapping = result.overlapping;
        std::sort(overlapping.begin(), overlapping.end());
        overlapping.erase(std::unique(overlapping.begin(), overlapping.end()), overlapping.end());
        if (!overlapping.empty())
            std::erase_if(relations, [&](std::uint64_t packed) {
                const Relation relation = unpacked(packed);
                const std::pair<CellId, CellId> pair = std::minmax(relation.front, relation.back);
                return std::binary_search(overlapping.begin(), overlapping.end(), pair);
            });
        result.relations.resize(relations.size());
        in_parallel(relations.size(), 4096, [&](std::size_t i) { result.relations[i] = unpacked(relations[i]); });
    }

private:
    void test(const BoundaryFace& f, const BoundaryFace& g, Found& found) const
    {
        const CellId front = f.owner.cell, back = g.owner.cell;
        if (front == back || (adjacency_ != nullptr && share_face(*adjacency_, front, back)))
            return;
        ++found.candidates;
        const Overlap overlap = face_overlap(f.seen, g.seen, eye_);
        if (overlap == Overlap::crossing)
            found.crossings.push_back(std::minmax(front, back));
        else if (overlap == Overlap::nearer || (overlap == Overlap::coincident && adjacency_ != nullptr))
            found.relations.push_back(packed(front, back));
    }

    const Scene& scene_;
    glm::dvec4 eye_;
    const Adjacency* adjacency_; // none in a surface scene, whose triangles' common edges say nothing of their order
    ExitsAndEntries faces_;
    oneapi::tbb::enumerable_thread_specific<Found> found_;
};

} // namespace

void boundary_relations(const Scene& scene, const glm::dvec4& eye, BoundaryRelations& result)
{
    Search search(scene, eye);
    search.run();
    search.collect(result);
}

} // namespace visorder
