#include "projection/visible_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace visorder {

namespace {

// Positive to the left of the way from a to b. Coordinates are below 2^22, see RasterLattice.
std::int64_t side(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& p)
{
    return std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{b.y - a.y} * (p.x - a.x);
}

bool holds(const glm::ivec2& a, const glm::ivec2& b, const glm::ivec2& c, const glm::ivec2& p)
{
    const std::int64_t ab = side(a, b, p);
    const std::int64_t bc = side(b, c, p);
    const std::int64_t ca = side(c, a, p);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

// More are left to the rasteriser.
constexpr int most_centres_tried = 6;

// Of the length of a ray's way through a cell, as a part of the scene's diameter.
constexpr double tolerance = 1e-5;
// What single precision makes of k.r: three roundings, each of 2^-24 at most.
constexpr double rounding = 3.0 / (1 << 24);
// Of the distances before the eye of a cell's points: projective depths are interpolated between them.
constexpr double most_foreshortened = 64;

double cross(const glm::dvec2& a, const glm::dvec2& b)
{
    return a.x * b.y - a.y * b.x;
}

glm::dvec2 flat(const glm::dvec3& p)
{
    return {p.x, p.y};
}

double distance_from_line(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p)
{
    const double length = glm::length(b - a);
    return length == 0 ? 0 : std::abs(cross(b - a, p - a)) / length;
}

} // namespace

VisibleCells::VisibleCells(const Scene& scene, std::span<const std::uint8_t> turned, const ScreenPoints& points,
                           const Screen& screen, const RasterLattice& lattice)
    : vertices_(scene.mesh().vertices),
      turned_(turned),
      points_(points),
      lattice_(lattice),
      first_(-screen.centre()),
      last_(screen.size() - screen.centre() - 1),
      half_step_(lattice.steps / 2),
      shift_(std::countr_zero(static_cast<unsigned>(lattice.steps))),
      inverse_distance_(screen.inverse_distance()),
      width_scale_(0),
      mirrored_(screen.mirrors())
{
    double longest = 0; // of the rays through the image's corners
    for (const double x : {first_.x, last_.x + 1})
        for (const double y : {first_.y, last_.y + 1})
            longest = std::max(longest, glm::length(screen.rays() * glm::dvec3(x, y, 1)));
    width_scale_ = rounding * longest / (tolerance * scene.diameter());
}

bool VisibleCells::covers_a_centre(const std::array<glm::ivec2, 3>& triangle) const
{
    const auto& [a, b, c] = triangle;
    // Pixel i has its centre at i steps + half_step.
    const glm::ivec2 low = glm::min(glm::min(a, b), c) - half_step_;
    const glm::ivec2 high = glm::max(glm::max(a, b), c) - half_step_;
    const int mask = (1 << shift_) - 1;
    const glm::ivec2 first = glm::max(glm::ivec2((low.x + mask) >> shift_, (low.y + mask) >> shift_), first_);
    const glm::ivec2 last = glm::min(glm::ivec2(high.x >> shift_, high.y >> shift_), last_);
    const int columns = last.x - first.x + 1;
    const int rows = last.y - first.y + 1;
    if (columns <= 0 || rows <= 0)
        return false;
    if (columns > most_centres_tried || rows > most_centres_tried || columns * rows > most_centres_tried)
        return true;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            if (holds(a, b, c, {(x << shift_) + half_step_, (y << shift_) + half_step_}))
                return true;
    return false;
}

VisibleCells::Sight VisibleCells::complete(VisibleCell& cell, const std::uint32_t* v) const
{
    const std::array<glm::dvec3, 4> at{points_.at[v[0]], points_.at[v[1]], points_.at[v[2]], points_.at[v[3]]};
    const Silhouette silhouette = silhouette_of({flat(at[0]), flat(at[1]), flat(at[2]), flat(at[3])});
    if (silhouette.kind == SilhouetteClass::empty)
        return Sight::none;
    cell.kind = silhouette.kind;
    const bool first_behind = silhouette.first_behind != turned(cell.cell);
    // The nearer edge of a quad comes first.
    const std::size_t rotated = silhouette.kind == SilhouetteClass::quad && first_behind ? 2 : 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint8_t point = silhouette.points[i ^ rotated];
        cell.points[i] = v[point];
        cell.at[i] = at[point];
    }
    cell.inner_behind = silhouette.kind == SilhouetteClass::triangle && first_behind;
    return judge(cell);
}

VisibleCells::Precision VisibleCells::precision_for(const VisibleCell& cell) const
{
    double longest = 0;
    double nearest = cell.at[0].z;
    double farthest = cell.at[0].z;
    for (const glm::dvec3& p : cell.at) {
        longest = std::max({longest, std::abs(p.x - cell.at[0].x), std::abs(p.y - cell.at[0].y)});
        nearest = std::min(nearest, p.z);
        farthest = std::max(farthest, p.z);
    }
    const double near_scale = 1 - nearest * inverse_distance_;
    const double far_scale = 1 - farthest * inverse_distance_;
    if (near_scale > most_foreshortened * far_scale)
        return {std::numeric_limits<double>::infinity(), 0};
    return {width_scale_ * longest * (farthest - nearest) / (far_scale * far_scale), 2 * rounding * longest};
}

VisibleCells::Sight VisibleCells::judge(VisibleCell& cell) const
{
    const Precision precision = precision_for(cell);
    const double wide = precision.wide_enough;
    if (std::isinf(wide))
        return Sight::apart;
    cell.least_width = std::min(precision.beside, wide);
    const std::array<glm::dvec2, 4> p{flat(cell.at[0]), flat(cell.at[1]), flat(cell.at[2]), flat(cell.at[3])};
    const auto within = [&](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& third, double width) {
        return centre_near(a, b, third, width + precision.beside);
    };
    if (cell.kind == SilhouetteClass::triangle) {
        for (std::size_t i = 1; i < 4; ++i) {
            const glm::dvec2& a = p[i];
            const glm::dvec2& b = p[i % 3 + 1];
            const double width = distance_from_line(a, b, p[0]);
            if (width >= wide)
                continue;
            // Of a cell that is narrow as a whole, nothing is left but what is close to its longest side.
            const glm::dvec2& third = p[(i + 1) % 3 + 1];
            const double whole = distance_from_line(a, b, third);
            if (within(a, b, third, whole < wide ? whole : width))
                return Sight::apart;
        }
        return Sight::clear;
    }
    for (const std::size_t first : {std::size_t{0}, std::size_t{2}}) {
        const glm::dvec2& a = p[2 - first];
        const glm::dvec2& b = p[3 - first];
        const double one = distance_from_line(a, b, p[first]);
        const double other = distance_from_line(a, b, p[first + 1]);
        if (one < other) {
            std::swap(cell.points[first], cell.points[first + 1]);
            std::swap(cell.at[first], cell.at[first + 1]);
        }
        const auto [narrower, wider] = std::minmax(one, other);
        if (narrower < wide && within(a, b, one < other ? p[first] : p[first + 1], wider < wide ? wider : narrower))
            return Sight::apart;
    }
    return Sight::clear;
}

// Whether a pixel's centre is so close to the line from a to b, between these or up to a third point near that line.
bool VisibleCells::centre_near(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& third, double distance) const
{
    const int along = std::abs(b.x - a.x) >= std::abs(b.y - a.y) ? 0 : 1;
    const int across = 1 - along;
    const double length = b[along] - a[along];
    const double slope = length == 0 ? 0 : (b[across] - a[across]) / length;
    const double reach = distance * std::sqrt(1 + slope * slope);
    // What is drawn reaches a step beyond the cell.
    const double beyond = distance + 2.0 / lattice_.steps;
    const auto pixel = [&](double x, double offset, double low, double high) {
        return static_cast<int>(std::clamp(std::floor(x + offset), low, high));
    };
    const double low = first_[along] - 1;
    const double high = last_[along] + 1;
    const int first = pixel(std::min({a[along], b[along], third[along]}) - beyond, -0.5, low, high);
    const int last = pixel(std::max({a[along], b[along], third[along]}) + beyond, 0.5, low, high);
    for (int i = std::max(first, first_[along]); i <= std::min(last, last_[along]); ++i) {
        const double on_line = a[across] + (i + 0.5 - a[along]) * slope;
        const double nearest = std::floor(on_line) + 0.5;
        if (reach >= 0.5 ||
            (std::abs(nearest - on_line) <= reach && nearest > first_[across] && nearest < last_[across] + 1))
            return true;
    }
    return false;
}

} // namespace visorder
