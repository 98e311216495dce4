#include "depth/image_extents.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;
constexpr double infinity = std::numeric_limits<double>::infinity();
// Beyond this, sums and products of a few coordinates might overflow.
constexpr double huge = 1e300;
// More than the roundings of some products that underflow add up to.
constexpr double underflow = 0x1p-1068;

bool is_finite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Coordinates in which cells are looked at: along `away`, to the `right`, and `up`. Any linear map would do, for rays
// from the eye stay rays; so it matters not that the axes, computed, are a little off unit length and right angles.
class Frame {
public:
    Frame(const Scene& scene, const glm::dvec4& eye) : parallel(eye.w == 0)
    {
        const glm::dvec3 middle = scene.bounds().middle();
        if (parallel) {
            origin_ = middle;
            set_axes(-glm::dvec3(eye));
            const glm::dvec3 half = scene.bounds().max * 0.5 - scene.bounds().min * 0.5;
            const double radius = half.x + half.y + half.z;
            // Let two points of the scene lie on one ray, up to 2 radius apart. With an axis off the true direction by
            // at most 12 u, their images are at most 24 u radius apart, and each is computed to within 6 u radius.
            error_ = radius < huge ? 1e-14 * radius : infinity;
        } else {
            origin_ = glm::dvec3(eye) / eye.w;
            const glm::dvec3 size = glm::abs(origin_);
            // Division by 1 or -1 does not round.
            error_ = std::abs(eye.w) == 1
                         ? 0
                         : 4 * (u * std::max({size.x, size.y, size.z}) + std::numeric_limits<double>::min());
            set_axes(middle * 0.5 - origin_ * 0.5);
        }
    }

    glm::dvec3 operator()(const glm::dvec3& point) const
    {
        const glm::dvec3 d = point - origin_;
        return {glm::dot(right_, d), glm::dot(up_, d), glm::dot(away_, d)};
    }

    // How far a point's image may be off, of a cell whose points have no greater coordinates than `size`; infinite
    // where doubles do not tell.
    double error(double size) const { return size < huge ? error_ + 32 * u * size + underflow : infinity; }

    const bool parallel;

private:
    void set_axes(const glm::dvec3& direction)
    {
        const glm::dvec3 size = glm::abs(direction);
        const double greatest = std::max({size.x, size.y, size.z});
        if (!(greatest > 0) || !std::isfinite(greatest))
            return;
        const glm::dvec3 scaled = direction / greatest;
        if (!is_finite(scaled))
            return;
        away_ = glm::normalize(scaled);
        const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                                 : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                      : glm::dvec3(0, 0, 1);
        right_ = glm::normalize(glm::cross(away_, least));
        up_ = glm::cross(right_, away_);
    }

    glm::dvec3 origin_;
    glm::dvec3 right_{1, 0, 0}, up_{0, 1, 0}, away_{0, 0, 1};
    double error_;
};

// A cell's vertices in a frame.
struct Points {
    std::array<glm::dvec3, max_cell_vertices> at;
    std::size_t count = 0;
    double size = 0; // no coordinate of any is greater
    double error = 0;

    Points(const Mesh& mesh, CellId cell, const Frame& frame)
    {
        for (PointId v : mesh.cell(cell)) {
            const glm::dvec3 x = frame(mesh.points[v]);
            at[count++] = x;
            size = is_finite(x) ? std::max(size, std::abs(x.x) + std::abs(x.y) + std::abs(x.z)) : infinity;
        }
        error = frame.error(size);
    }

    const glm::dvec3* begin() const { return at.data(); }
    const glm::dvec3* end() const { return at.data() + count; }
};

struct RawExtent {
    CellId cell;
    std::uint32_t plane;
    Box box;
};

constexpr Box everywhere{glm::dvec3(-huge), glm::dvec3(huge)};

Box widened(const Box& box, const glm::dvec3& by)
{
    return {glm::max(box.min - by, glm::dvec3(-huge)), glm::min(box.max + by, glm::dvec3(huge))};
}

Box along_direction(const Points& points)
{
    if (points.error == infinity)
        return everywhere;
    Box box;
    for (const glm::dvec3& x : points)
        box.add(x);
    return widened(box, glm::dvec3(points.error));
}

// Side `side` of the cube shows the rays with |x| <= z and |y| <= z, where z is along one of the axes or against it,
// and x and y are along the others; their image is (x / z, y / z). The part of a convex cell with z > 0 lies in the
// image within that of its vertices, if all have z > 0. Returns false where the side does not show the cell.
bool in_side(const Points& points, std::uint32_t side, Box& box)
{
    constexpr std::array<int, 3> axes{2, 0, 1};
    const int axis = axes[side / 2];
    const double towards = side % 2 == 0 ? 1 : -1;
    if (points.error == infinity) {
        box = {{-1, -1, 0}, {1, 1, huge}};
        return true;
    }
    std::array<glm::dvec3, max_cell_vertices> turned;
    Box bounds;
    double most_left = infinity, most_right = infinity, most_low = infinity, most_high = infinity;
    for (std::size_t i = 0; i < points.count; ++i) {
        const glm::dvec3& p = points.at[i];
        const glm::dvec3 x{p[(axis + 1) % 3], p[(axis + 2) % 3], towards * p[axis]};
        turned[i] = x;
        bounds.add(x);
        most_left = std::min(most_left, -x.x - x.z);
        most_right = std::min(most_right, x.x - x.z);
        most_low = std::min(most_low, -x.y - x.z);
        most_high = std::min(most_high, x.y - x.z);
    }
    // Outside of the pyramid of the side by more than both coordinates may be off.
    if (std::max({most_left, most_right, most_low, most_high, -bounds.max.z}) > 4 * points.error)
        return false;
    const double near = std::max(bounds.min.z - points.error, 0.0), far = bounds.max.z + points.error;
    if (!(bounds.min.z > 0x1p-10 * points.size + 4 * points.error)) {
        box = {{-1, -1, near}, {1, 1, far}};
        return true;
    }
    Box image;
    for (std::size_t i = 0; i < points.count; ++i)
        image.add(glm::dvec3(turned[i].x / turned[i].z, turned[i].y / turned[i].z, 0));
    // |x / z| is at most 2^10; errors of both move it by at most (1 + |x / z|) error / (z - error), and by its
    // rounding.
    const double greatest = std::max({-image.min.x, -image.min.y, image.max.x, image.max.y, 0.0});
    const double margin = 4 * (1 + greatest) * (points.error / bounds.min.z + u);
    box = {{std::max(image.min.x - margin, -1.0), std::max(image.min.y - margin, -1.0), near},
           {std::min(image.max.x + margin, 1.0), std::min(image.max.y + margin, 1.0), far}};
    return box.min.x <= box.max.x && box.min.y <= box.max.y;
}

// Maps a range onto [0, 1], rounded, but never out of order.
struct Scale {
    double low, factor;

    Scale(double low_, double high) : low(low_), factor(1 / (high - low_))
    {
        if (!std::isfinite(factor) || !std::isfinite(high - low_))
            factor = 0;
    }
    float operator()(double x) const { return static_cast<float>((x - low) * factor); }
};

} // namespace

void ImageExtents::evaluate(const Scene& scene, const glm::dvec4& eye)
{
    const Frame frame(scene, eye);
    const Mesh& mesh = scene.mesh();
    const CellId cells = scene.cell_count();
    parallel_ = frame.parallel;
    plane_count_ = parallel_ ? 1 : 6;
    begin_.resize(std::size_t{cells} + 1);
    farthest_.resize(cells);
    spheres_.resize(cells);

    const auto sphere_of = [&](const Points& points) {
        // Squares are to stay in range.
        if (!(points.size < 1e100 && points.size > 1e-100 && points.error < 1e100))
            return Sphere{glm::dvec3(0), infinity, glm::dvec3(0), infinity};
        Sphere sphere{};
        for (const glm::dvec3& x : points)
            sphere.centre += x / static_cast<double>(points.count);
        for (const glm::dvec3& x : points)
            sphere.radius = std::max(sphere.radius, glm::length(x - sphere.centre));
        sphere.radius += 2 * points.error + 1e-14 * points.size;
        if (parallel_) {
            sphere.axis = {sphere.centre.x, sphere.centre.y, 0};
            sphere.reach = sphere.radius;
            return sphere;
        }
        const double distance = glm::length(sphere.centre);
        // Where the eye is in the sphere or close to it, the cone takes in everything. The arcsine is good to 1e-14.
        const bool close = !(sphere.radius < 0.99 * distance);
        sphere.axis = close ? glm::dvec3(0) : sphere.centre / distance;
        sphere.reach = close ? infinity : std::asin(sphere.radius / distance) + 2e-14;
        return sphere;
    };

    constexpr CellId block_size = 1024;
    std::vector<std::vector<RawExtent>> blocks((cells + block_size - 1) / block_size);
    oneapi::tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t block) {
        const auto first = static_cast<CellId>(block * block_size);
        const CellId last = std::min(cells, first + block_size);
        for (CellId cell = first; cell < last; ++cell) {
            const Points points(mesh, cell, frame);
            spheres_[cell] = sphere_of(points);
            double farthest = -infinity;
            for (const glm::dvec3& x : points)
                farthest =
                    std::max(farthest, parallel_ ? x.z : std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}));
            farthest_[cell] = std::isnan(farthest) ? infinity : farthest;
            const std::size_t before = blocks[block].size();
            if (parallel_) {
                blocks[block].push_back({cell, 0, along_direction(points)});
            } else {
                for (std::uint32_t side = 0; side < plane_count_; ++side)
                    if (Box box; in_side(points, side, box))
                        blocks[block].push_back({cell, side, box});
            }
            begin_[cell + 1] = blocks[block].size() - before;
        }
    });
    begin_[0] = 0;
    for (CellId cell = 0; cell < cells; ++cell)
        begin_[cell + 1] += begin_[cell];

    std::array<Box, 6> ranges;
    for (const auto& block : blocks)
        for (const RawExtent& raw : block)
            ranges[raw.plane].add(raw.box);
    extents_.resize(begin_[cells]);
    oneapi::tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t block) {
        std::size_t at = begin_[block * block_size];
        for (const RawExtent& raw : blocks[block]) {
            const Box& range = ranges[raw.plane];
            const Scale x(range.min.x, range.max.x), y(range.min.y, range.max.y), z(range.min.z, range.max.z);
            extents_[at++] = {raw.cell,         raw.plane,        x(raw.box.min.x), x(raw.box.max.x),
                              y(raw.box.min.y), y(raw.box.max.y), z(raw.box.min.z), z(raw.box.max.z)};
        }
    });
}

bool ImageExtents::cones_apart(CellId a, CellId b) const
{
    // An angle is no less than its chord. Of the sums here all but a few u is right; 1e-15 is 9 u.
    const glm::dvec3 chord = spheres_[a].axis - spheres_[b].axis;
    const double reach = (spheres_[a].reach + spheres_[b].reach) * (1 + 1e-15);
    return glm::dot(chord, chord) * (1 - 1e-15) > reach * reach;
}

bool ImageExtents::sphere_behind(CellId a, CellId b) const
{
    // The plane that touches a's sphere where it faces b has the eye and b on one side.
    const Sphere &behind = spheres_[a], &before = spheres_[b];
    const glm::dvec3 n = behind.centre - before.centre;
    const double length = glm::length(n);
    if (!(length * (1 - 1e-14) > behind.radius + before.radius))
        return false;
    return parallel_ ? n.z > 1e-13 * length : glm::dot(behind.centre, n) > behind.radius * length * (1 + 1e-14);
}

} // namespace visorder::detail
