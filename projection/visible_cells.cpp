#include "projection/visible_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace visorder::detail {

namespace {

// Of the length of a ray's way through a cell, as a part of the scene's diameter.
constexpr double tolerance = 1e-5;
// Likewise, as a part of the way where the cell is thickest.
constexpr double thickness_tolerance = 2e-6;
// Of the distances before the eye of a cell's points: projective depths are interpolated between them.
constexpr double most_foreshortened = 64;

// Of a cell, in pixels along either axis from its first point: outlines of longer slivers, which are made wider (see
// outline_of), would leave the lattice.
constexpr double most_longest = 3072;

// Of a face, in pixels: so that nothing is divided by zero.
constexpr double least_width = 1e-12;

// Times the width of a face.
double error_of(double longest)
{
    const double reach = longest + 2;
    return 8 * 0x1p-47 * reach * reach;
}

glm::dvec2 flat(const glm::dvec3& p)
{
    return {p.x, p.y};
}

// Of a triangle, by twice its area, over one side.
double height(double area, const glm::dvec2& a, const glm::dvec2& b)
{
    const double length = glm::length(b - a);
    return length == 0 ? 0 : area / length;
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
      length_scale_(0),
      mirrored_(screen.mirrors())
{
    length_scale_ = screen.longest_ray() / (tolerance * scene.diameter());
}

VisibleCells::Pixels VisibleCells::pixels_in(const glm::ivec2& low, const glm::ivec2& high) const
{
    // Pixel i has its centre at i steps + half_step.
    const int mask = (1 << shift_) - 1;
    const glm::ivec2 first = low - half_step_ + mask;
    const glm::ivec2 last = high - half_step_;
    return {glm::max(glm::ivec2(first.x >> shift_, first.y >> shift_), first_),
            glm::min(glm::ivec2(last.x >> shift_, last.y >> shift_), last_)};
}

bool VisibleCells::may_cover(const std::array<glm::ivec2, 3>& triangle) const
{
    return !pixels_in(glm::min(glm::min(triangle[0], triangle[1]), triangle[2]),
                      glm::max(glm::max(triangle[0], triangle[1]), triangle[2]))
                .none();
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
        cell.areas[i] = silhouette.areas[i ^ rotated];
    }
    cell.counterclockwise = silhouette.counterclockwise == (rotated == 0);
    cell.inner_behind = silhouette.kind == SilhouetteClass::triangle && first_behind;
    return judge(cell);
}

VisibleCells::Precision VisibleCells::precision_for(VisibleCell& cell) const
{
    double longest = 0;
    double nearest = cell.at[0].z;
    double farthest = cell.at[0].z;
    for (const glm::dvec3& p : cell.at) {
        longest = std::max({longest, std::abs(p.x - cell.at[0].x), std::abs(p.y - cell.at[0].y)});
        nearest = std::min(nearest, p.z);
        farthest = std::max(farthest, p.z);
    }
    cell.longest = longest;
    cell.nearest = nearest;
    cell.farthest = farthest;
    const double near_scale = 1 - nearest * inverse_distance_;
    const double far_scale = 1 - farthest * inverse_distance_;
    if (near_scale > most_foreshortened * far_scale || longest > most_longest)
        return {std::numeric_limits<double>::infinity(), 0, longest};
    constexpr double diagonal = 1.4143;
    const double error = error_of(longest);
    const double of_diameter = length_scale_ * (farthest - nearest) / (far_scale * far_scale);
    return {error * std::max(of_diameter, 1 / thickness_tolerance), 2 * error, diagonal * longest};
}

VisibleCells::Sight VisibleCells::judge(VisibleCell& cell) const
{
    const Precision precision = precision_for(cell);
    const double wide = precision.wide_enough;
    if (std::isinf(wide))
        return Sight::apart;
    const bool triangle = cell.kind == SilhouetteClass::triangle;
    if (!triangle) {
        // Of either edge first the end that is farther off the other edge's line.
        for (const std::size_t first : {std::size_t{0}, std::size_t{2}})
            if (cell.areas[first + 1] < cell.areas[first]) {
                std::swap(cell.points[first], cell.points[first + 1]);
                std::swap(cell.at[first], cell.at[first + 1]);
                std::swap(cell.areas[first], cell.areas[first + 1]);
                cell.counterclockwise = !cell.counterclockwise;
            }
    }
    const double least_area =
        triangle ? std::min({cell.areas[1], cell.areas[2], cell.areas[3]}) : std::min(cell.areas[0], cell.areas[2]);
    cell.least_width = 0;
    if (least_area > wide * precision.longest)
        return Sight::clear;
    cell.least_width = std::max(std::min(precision.beside, wide), least_width);
    const std::array<glm::dvec2, 4> p{flat(cell.at[0]), flat(cell.at[1]), flat(cell.at[2]), flat(cell.at[3])};
    const auto within = [&](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& third, double width) {
        return centre_near(a, b, third, width + precision.beside);
    };
    if (triangle) {
        for (std::size_t i = 1; i < 4; ++i) {
            const std::size_t next = i % 3 + 1;
            const std::size_t other = next % 3 + 1;
            const double width = height(cell.areas[other], p[i], p[next]);
            if (width >= wide)
                continue;
            // Of a cell that is narrow as a whole, nothing is left but what is close to its longest side.
            const double whole = height(cell.areas[0], p[i], p[next]);
            if (within(p[i], p[next], p[other], whole < wide ? whole : width))
                return Sight::apart;
        }
        return Sight::clear;
    }
    for (const std::size_t first : {std::size_t{0}, std::size_t{2}}) {
        // The other edge, and how far off its line the ends of this one are.
        const glm::dvec2& a = p[2 - first];
        const glm::dvec2& b = p[3 - first];
        const double wider = height(cell.areas[first + 1], a, b);
        const double narrower = height(cell.areas[first], a, b);
        if (narrower < wide && within(a, b, p[first + 1], wider < wide ? wider : narrower))
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

} // namespace visorder::detail
