#include "visorder/ray_caster.h"

#include "checking/cell_crossing.h"
#include "checking/pixel_rays.h"
#include "checking/silhouettes.h"
#include "optics/medium_integral.h"
#include "parallel/large_array.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder {

using namespace detail;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int tile_size = 16;

void check(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    if (!scene.is_tetrahedral()) {
        CellId lowest = std::numeric_limits<CellId>::max();
        for (CellId cell = 0; cell < scene.cell_count(); ++cell)
            if (mesh.shapes[cell] != CellShape::tetrahedron)
                lowest = std::min(lowest, scene.caller_cells()[cell]);
        throw CellError(lowest, "not a tetrahedron; subdivide the mesh first");
    }
    if (mesh.scalars.empty())
        throw InputError("the mesh has no scalars to colour it by");
    for (std::size_t point = 0; point < mesh.scalars.size(); ++point)
        if (!std::isfinite(mesh.scalars[point]))
            throw InputError(
                fmt::format("point {}: scalar {} is not finite", scene.caller_points()[point], mesh.scalars[point]));
}

/// Pixels from `first` up to `last` along one axis of the image.
struct PixelRange {
    int first, last;
};

// The pixels along one axis whose rays can meet a cell with these vertices, by their coordinates along the axis and
// their w. The cell is on one side of the plane through the eye and coordinate p if x - p w has one sign at all
// vertices: so it is for p between x / w of all vertices before the eye and x / w of all behind it. Where that leaves
// pixels on both sides of such a gap, all between count too.
PixelRange pixels_met(const std::array<double, 4>& x, const std::array<double, 4>& w, double noise, int size)
{
    double before_low = infinity, before_high = -infinity, behind_low = infinity, behind_high = -infinity;
    bool above_is_free = true, below_is_free = true;
    for (std::size_t i = 0; i < 4; ++i) {
        if (std::abs(w[i]) <= noise) {
            above_is_free = above_is_free && x[i] < -noise * size;
            below_is_free = below_is_free && x[i] > noise * size;
        } else if (w[i] > 0) {
            before_low = std::min(before_low, x[i] / w[i]);
            before_high = std::max(before_high, x[i] / w[i]);
        } else {
            behind_low = std::min(behind_low, x[i] / w[i]);
            behind_high = std::max(behind_high, x[i] / w[i]);
        }
    }
    double low = 0, high = size;
    if (above_is_free && behind_low > high)
        high = std::min(high, before_high);
    if (above_is_free && before_high < 0)
        low = std::max(low, behind_low);
    if (below_is_free && behind_high < 0)
        low = std::max(low, before_low);
    if (below_is_free && before_low > size)
        high = std::min(high, behind_high);
    // A thousandth of a pixel is far beyond all rounding.
    const double first = std::clamp(std::ceil(low - 0.501), 0.0, size * 1.0);
    const double last = std::clamp(std::floor(high - 0.499) + 1, first, size * 1.0);
    return {static_cast<int>(first), static_cast<int>(last)};
}

struct Cell {
    std::array<PointId, 4> vertices; // ascending
    PixelRange x, y;
};

struct Segment {
    double enter, leave;
    double scalar_at_enter, scalar_at_leave;
    CellId cell;
    std::uint32_t pixel; // within its tile

    bool operator<(const Segment& other) const
    {
        if (enter != other.enter)
            return enter < other.enter;
        return leave != other.leave ? leave < other.leave : cell < other.cell;
    }
};

class Caster {
public:
    Caster(const Scene& scene, std::span<const MediumPoint> medium, const View& view, const RayCastOptions& options)
        : mesh_(scene.mesh()),
          medium_(medium),
          rays_(view, scene.bounds().middle()),
          size_(view.size),
          options_(options),
          points_(scene.mesh().points.size()),
          cells_(scene.cell_count())
    {
        see_points();
        find_pixels();
        assign_to_tiles();
    }

    RayCast cast() const
    {
        RayCast result{size_, {}, {}};
        result.pixels.resize(static_cast<std::size_t>(size_.x) * static_cast<std::size_t>(size_.y));
        oneapi::tbb::parallel_for(std::size_t{0}, tile_begin_.size() - 1,
                                  [&](std::size_t tile) { cast(tile, result.pixels); });
        return result;
    }

    const PixelRays& rays() const { return rays_; }

private:
    void see_points()
    {
        oneapi::tbb::parallel_for(std::size_t{0}, points_.size(),
                                  [&](std::size_t i) { points_[i] = rays_.seen(mesh_.points[i]); });
    }

    void find_pixels()
    {
        double largest = 0;
        for (const SeenPoint& p : points_)
            largest = std::max({largest, std::abs(p.w), std::abs(p.x) / size_.x, std::abs(p.y) / size_.y});
        // Of a vertex at the eye, nothing but rounding is left.
        const double noise = 1e-12 * largest;
        oneapi::tbb::parallel_for(CellId{0}, static_cast<CellId>(cells_.size()), [&](CellId i) {
            Cell& cell = cells_[i];
            std::copy_n(mesh_.cell(i).begin(), 4, cell.vertices.begin());
            std::sort(cell.vertices.begin(), cell.vertices.end());
            std::array<double, 4> x{}, y{}, w{};
            for (std::size_t k = 0; k < 4; ++k) {
                const SeenPoint& p = points_[cell.vertices[k]];
                x[k] = p.x + rays_.x_constant(0);
                y[k] = p.y + rays_.y_constant(0);
                w[k] = rays_.w(p);
            }
            const bool behind = *std::max_element(w.begin(), w.end()) < -noise;
            cell.x = behind ? PixelRange{0, 0} : pixels_met(x, w, noise, size_.x);
            cell.y = behind ? PixelRange{0, 0} : pixels_met(y, w, noise, size_.y);
        });
    }

    template <class Visit>
    void each_tile(const Cell& cell, const Visit& visit) const
    {
        if (cell.x.first == cell.x.last || cell.y.first == cell.y.last)
            return;
        for (int y = cell.y.first / tile_size; y <= (cell.y.last - 1) / tile_size; ++y)
            for (int x = cell.x.first / tile_size; x <= (cell.x.last - 1) / tile_size; ++x)
                visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles_across()) +
                      static_cast<std::size_t>(x));
    }

    void assign_to_tiles()
    {
        const int tiles_up = (size_.y + tile_size - 1) / tile_size;
        tile_begin_.assign(static_cast<std::size_t>(tiles_across()) * static_cast<std::size_t>(tiles_up) + 1, 0);
        for (const Cell& cell : cells_)
            each_tile(cell, [&](std::size_t tile) { ++tile_begin_[tile]; });
        std::size_t end = 0;
        for (std::size_t& begin : tile_begin_)
            begin = end += begin;
        tile_cells_.resize(end);
        // Filled from each tile's end, so that its counter comes to rest on its beginning.
        for (CellId i = static_cast<CellId>(cells_.size()); i-- > 0;)
            each_tile(cells_[i], [&](std::size_t tile) { tile_cells_[--tile_begin_[tile]] = i; });
    }

    int tiles_across() const { return (size_.x + tile_size - 1) / tile_size; }

    void cast(std::size_t tile, std::vector<glm::dvec4>& pixels) const
    {
        const int left = static_cast<int>(tile % static_cast<std::size_t>(tiles_across())) * tile_size;
        const int bottom = static_cast<int>(tile / static_cast<std::size_t>(tiles_across())) * tile_size;
        std::vector<Segment> segments;
        for (std::size_t i = tile_begin_[tile]; i < tile_begin_[tile + 1]; ++i)
            cross_cell(tile_cells_[i], left, bottom, segments);
        std::array<std::size_t, tile_size * tile_size + 1> begins{};
        segments = by_pixel(segments, begins);
        for (std::size_t pixel = 0; pixel + 1 < begins.size(); ++pixel) {
            const std::span<Segment> along(segments.data() + begins[pixel], segments.data() + begins[pixel + 1]);
            if (along.empty())
                continue;
            std::sort(along.begin(), along.end());
            const int x = left + static_cast<int>(pixel) % tile_size;
            const int y = bottom + static_cast<int>(pixel) / tile_size;
            pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(x)] =
                integrate(along, x + 0.5, y + 0.5);
        }
    }

    // A tile's segments, those of one pixel together, and where those of each begin.
    static std::vector<Segment> by_pixel(const std::vector<Segment>& segments, std::span<std::size_t> begins)
    {
        for (const Segment& segment : segments)
            ++begins[segment.pixel];
        std::size_t end = 0;
        for (std::size_t& begin : begins)
            begin = end += begin;
        std::vector<Segment> result(segments.size());
        for (const Segment& segment : segments)
            result[--begins[segment.pixel]] = segment;
        return result;
    }

    // Appends the segments of a cell in the pixels of a tile.
    void cross_cell(CellId id, int left, int bottom, std::vector<Segment>& segments) const
    {
        const Cell& cell = cells_[id];
        std::array<SeenVertex, 4> v{};
        for (std::size_t k = 0; k < 4; ++k) {
            const SeenPoint& p = points_[cell.vertices[k]];
            v[k] = {0, 0, rays_.w(p), p.depth, static_cast<double>(mesh_.scalars[cell.vertices[k]])};
        }
        Crossing crossing{};
        for (int y = std::max(bottom, cell.y.first); y < std::min(bottom + tile_size, cell.y.last); ++y) {
            const double py = y + 0.5;
            for (std::size_t k = 0; k < 4; ++k)
                v[k].y = points_[cell.vertices[k]].y - py * points_[cell.vertices[k]].w + rays_.y_constant(py);
            for (int x = std::max(left, cell.x.first); x < std::min(left + tile_size, cell.x.last); ++x) {
                const double px = x + 0.5;
                for (std::size_t k = 0; k < 4; ++k)
                    v[k].x = points_[cell.vertices[k]].x - px * points_[cell.vertices[k]].w + rays_.x_constant(px);
                if (cross(v, crossing))
                    segments.push_back({crossing.depth[0], crossing.depth[1], crossing.scalar[0], crossing.scalar[1],
                                        id, static_cast<std::uint32_t>((y - bottom) * tile_size + x - left)});
            }
        }
    }

    glm::dvec4 integrate(std::span<const Segment> segments, double px, double py) const
    {
        double first = rays_.first_depth();
        double last = infinity;
        if (options_.clip_near_and_far) {
            first = std::fmax(first, rays_.depth_at(px, py, -1));
            last = std::fmin(last, rays_.depth_at(px, py, 1)); // not a number where the far plane is at infinity
        }
        const double length = rays_.length_per_depth(px, py);
        Light light;
        for (const Segment& s : segments) {
            const double enter = std::max(s.enter, first);
            const double leave = std::min(s.leave, last);
            if (enter >= leave)
                continue;
            const auto scalar_at = [&](double depth) {
                const double t = (depth - s.enter) / (s.leave - s.enter);
                return (1 - t) * s.scalar_at_enter + t * s.scalar_at_leave;
            };
            medium_.pass(light, (leave - enter) * length, enter == s.enter ? s.scalar_at_enter : scalar_at(enter),
                         leave == s.leave ? s.scalar_at_leave : scalar_at(leave));
            if (light.transmittance <= MediumIntegral::opaque)
                break;
        }
        return {light.colour, 1 - light.transmittance};
    }

    const Mesh& mesh_;
    MediumIntegral medium_;
    PixelRays rays_;
    glm::ivec2 size_;
    RayCastOptions options_;
    LargeArray<SeenPoint> points_;
    LargeArray<Cell> cells_;
    std::vector<std::size_t> tile_begin_;
    std::vector<CellId> tile_cells_;
};

} // namespace

RayCast cast_rays(const Scene& scene, std::span<const MediumPoint> medium, const View& view,
                  const RayCastOptions& options)
{
    check(scene);
    const Caster caster(scene, medium, view, options);
    RayCast result = caster.cast();
    if (options.silhouette_margin > 0)
        result.near_silhouette = silhouette_pixels(scene, view, caster.rays(), options.silhouette_margin);
    return result;
}

Image image_of(const RayCast& cast)
{
    Image image{cast.size, {}};
    image.pixels.assign(cast.pixels.begin(), cast.pixels.end());
    return image;
}

} // namespace visorder
