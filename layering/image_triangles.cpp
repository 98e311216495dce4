#include "layering/image_triangles.h"

#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_loop.h"
#include "visorder/scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

constexpr double nearest_part = 1e-6;   // of the farthest point's distance from the plane of the eye
constexpr double larger_by = 1.0 / 256; // pixels; corners move by less than 0.003,
constexpr double rounded_by = 0x1p-21;  // and by this part of their coordinates
constexpr double longest_tip = 16;      // pixels

// Homogeneous pixel coordinates, and the depth times w.
struct ImagePoint {
    double x, y, w, depth;
    bool in_front;

    glm::dvec2 pixel() const { return {x / w, y / w}; }
};

// How clip coordinates become image points.
class ImageSpace {
public:
    ImageSpace(const ItemMesh& items, std::span<const glm::dvec3> points, const glm::dmat4& world_to_clip,
               glm::ivec2 size)
        : size_(size), clip_(points.size())
    {
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, points.size(), 4096),
                                  [&](const auto& range) {
                                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                                          clip_[i] = world_to_clip * glm::dvec4(points[i], 1);
                                  });
        double least = std::numeric_limits<double>::infinity(), farthest = 0;
        for (const glm::dvec4& p : clip_) {
            least = std::min(least, p.w);
            farthest = std::max(farthest, p.w);
        }
        nearest_w_ = farthest > 0 ? std::max(least, nearest_part * farthest) : std::numeric_limits<double>::infinity();
        for (const glm::dvec4& p : clip_)
            if (p.w >= nearest_w_)
                add_depth(p);
        if (least < nearest_w_)
            for (const auto& triangle : items.triangles)
                for (std::size_t i = 0; i < 3; ++i)
                    add_crossing(clip_[triangle[i]], clip_[triangle[(i + 1) % 3]]);
    }

    ImagePoint at(PointId point) const
    {
        const glm::dvec4& p = clip_[point];
        const double range = depth_to_ > depth_from_ ? depth_to_ - depth_from_ : 1;
        return {(p.x + p.w) / 2 * size_.x, (p.y + p.w) / 2 * size_.y, p.w, (depth_to_ * p.w - p.z) / range,
                p.w >= nearest_w_};
    }

    // Clip coordinates whose z cuts off at the nearest w, and nothing else.
    glm::vec4 clip_position(PointId point) const
    {
        const glm::dvec4& p = clip_[point];
        return {p.x, p.y, (p.w - nearest_w_) / 2, p.w};
    }

    glm::vec4 clip_position(const glm::dvec2& pixel) const
    {
        const glm::dvec2 unit = 2.0 * pixel / glm::dvec2(size_) - 1.0;
        return {unit, 0.5, 1};
    }

private:
    void add_depth(const glm::dvec4& p)
    {
        depth_from_ = std::min(depth_from_, p.z / p.w);
        depth_to_ = std::max(depth_to_, p.z / p.w);
    }

    void add_crossing(const glm::dvec4& a, const glm::dvec4& b)
    {
        if ((a.w >= nearest_w_) != (b.w >= nearest_w_)) {
            const double t = (nearest_w_ - a.w) / (b.w - a.w);
            add_depth({0, 0, a.z + t * (b.z - a.z), nearest_w_});
        }
    }

    glm::ivec2 size_;
    std::vector<glm::dvec4> clip_;
    double nearest_w_;
    double depth_from_ = std::numeric_limits<double>::infinity();
    double depth_to_ = -std::numeric_limits<double>::infinity();
};

bool may_cover_a_sample(const std::array<glm::dvec2, 3>& corners, glm::ivec2 size)
{
    for (int axis = 0; axis < 2; ++axis) {
        const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
        const double first = std::max(std::ceil(low - 0.5), 0.0);
        const double last = std::min(std::floor(high - 0.5), size[axis] - 1.0);
        if (!(first <= last))
            return false;
    }
    return true;
}

// The corners of a triangle whose sides are moved outwards.
std::array<glm::dvec2, 3> enlarged(const std::array<glm::dvec2, 3>& corners, double turn)
{
    std::array<glm::dvec2, 3> normals; // of the side that starts at each corner, outwards
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 along = corners[(i + 1) % 3] - corners[i];
        const double length = glm::length(along);
        normals[i] = length > 0 ? glm::dvec2(along.y, -along.x) * (turn / length) : glm::dvec2(0);
    }
    double by = larger_by;
    for (const glm::dvec2& corner : corners)
        by = std::max({by, rounded_by * std::abs(corner.x), rounded_by * std::abs(corner.y)});
    std::array<glm::dvec2, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 sum = normals[i] + normals[(i + 2) % 3];
        const double square = glm::dot(sum, sum); // 2 + 2 cos of the angle between the normals
        glm::dvec2 move = square > 0 ? sum * (2 * by / square) : glm::dvec2(0);
        if (const double length = glm::length(move); length > longest_tip)
            move *= longest_tip / length;
        result[i] = corners[i] + move;
    }
    return result;
}

bool make_triangle(const ImageSpace& space, const std::array<PointId, 3>& points, glm::ivec2 size,
                   ImageTriangle& result)
{
    std::array<ImagePoint, 3> p{space.at(points[0]), space.at(points[1]), space.at(points[2])};
    const auto in_front = static_cast<int>(p[0].in_front) + p[1].in_front + p[2].in_front;
    if (in_front == 0)
        return false;
    const ImagePoint& seen = p[0].in_front ? p[0] : p[1].in_front ? p[1] : p[2];
    std::array<glm::dvec2, 3> corners{};
    if (in_front == 3) {
        corners = {p[0].pixel(), p[1].pixel(), p[2].pixel()};
        if (!may_cover_a_sample(corners, size))
            return false;
    }
    // A near corner loses digits if it lies far beside the image.
    const glm::dvec2 origin = glm::clamp(glm::floor(seen.pixel()), glm::dvec2(0), glm::dvec2(size));
    result.origin = glm::ivec2(origin);
    std::array<glm::dvec3, 3> rows;
    for (std::size_t i = 0; i < 3; ++i)
        rows[i] = {p[i].x - origin.x * p[i].w, p[i].y - origin.y * p[i].w, p[i].w};
    const std::array<glm::dvec3, 3> edges{glm::cross(rows[1], rows[2]), glm::cross(rows[2], rows[0]),
                                          glm::cross(rows[0], rows[1])};
    const double determinant = glm::dot(rows[0], edges[0]);
    result.depth = glm::dvec3(0);
    for (std::size_t i = 0; i < 3; ++i) {
        result.edges[i] = edges[i] / determinant;
        result.depth += p[i].depth * result.edges[i];
        for (int k = 0; k < 3; ++k)
            if (!std::isfinite(result.edges[i][k]))
                return false; // edge-on, as far as doubles can tell, or beyond them
    }
    if (in_front == 3) {
        // Pixel coordinates turn as the determinant does.
        const std::array<glm::dvec2, 3> larger = enlarged(corners, determinant > 0 ? 1 : -1);
        for (std::size_t i = 0; i < 3; ++i)
            result.corners[i] = space.clip_position(larger[i]);
    } else {
        for (std::size_t i = 0; i < 3; ++i)
            result.corners[i] = space.clip_position(points[i]);
    }
    return true;
}

} // namespace

ItemMesh surface_items(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    ItemMesh items;
    items.triangles.resize(scene.cell_count());
    items.begin.resize(scene.cell_count() + std::size_t{1});
    for (CellId cell = 0; cell < scene.cell_count(); ++cell) {
        const auto vertices = mesh.cell(cell);
        items.triangles[scene.caller_cells()[cell]] = {vertices[0], vertices[1], vertices[2]};
        items.begin[cell + 1] = cell + 1;
    }
    return items;
}

ItemMesh boundary_items(const Scene& scene)
{
    ItemMesh items;
    items.begin.push_back(0);
    for (const CellFace& face : scene.boundary().faces) {
        const FaceLoop loop = boundary_loop(scene.mesh(), face);
        for (int i = 2; i < loop.count; ++i)
            items.triangles.push_back({loop.begin()[0], loop.begin()[i - 1], loop.begin()[i]});
        items.begin.push_back(static_cast<std::uint32_t>(items.triangles.size()));
    }
    return items;
}

void project(const ItemMesh& items, std::span<const std::uint8_t> wanted, std::span<const glm::dvec3> points,
             const glm::dmat4& world_to_clip, glm::ivec2 size, ImageTriangles& result)
{
    const ImageSpace space(items, points, world_to_clip, size);
    const std::uint32_t count = items.item_count();
    // First each triangle in its place, then those that are seen moved up.
    result.triangles.resize(items.triangles.size());
    std::vector<std::uint8_t> seen(items.triangles.size(), 0);
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, count, 512), [&](const auto& range) {
        for (std::uint32_t item = range.begin(); item < range.end(); ++item)
            for (std::uint32_t t = items.begin[item]; wanted[item] != 0 && t < items.begin[item + 1]; ++t) {
                result.triangles[t].item = item;
                seen[t] = make_triangle(space, items.triangles[t], size, result.triangles[t]) ? 1 : 0;
            }
    });
    result.begin.assign(count + std::size_t{1}, 0);
    std::uint32_t kept = 0;
    for (std::uint32_t item = 0; item < count; ++item) {
        for (std::uint32_t t = items.begin[item]; t < items.begin[item + 1]; ++t)
            if (seen[t] != 0)
                result.triangles[kept++] = result.triangles[t];
        result.begin[item + 1] = kept;
    }
    result.triangles.resize(kept);
}

} // namespace visorder::detail
