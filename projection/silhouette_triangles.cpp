#include "projection/silhouette_triangles.h"

#include "projection/optical_passes.h"
#include "projection/thickness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace visorder {

namespace {

// Added to a place, in pixels, so that its coordinates are positive and their signs can say something else.
constexpr float place_offset = 16384;

// A triangle around a quad that is little larger, if there is one: the sides next to one of the quad's sides meet
// beyond it. One triangle in place of two, and thickness is zero where the quad is not. (Of a quad, points 0 and 1 are
// opposite corners, as are 2 and 3.)
std::optional<std::array<glm::vec2, 3>> triangle_around(const std::array<glm::ivec2, 4>& at, double pixels_a_step)
{
    constexpr double most_added = 0.6;   // of the quad's area
    constexpr double least_sine = 0.05;  // of the angle at the new corner
    constexpr double margin = 1.0 / 128; // pixels: the new corner will be rounded to the lattice
    const std::array<glm::dvec2, 4> v{glm::dvec2(at[0] - at[0]), glm::dvec2(at[2] - at[0]), glm::dvec2(at[1] - at[0]),
                                      glm::dvec2(at[3] - at[0])};
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const double area = std::abs(cross(v[2] - v[0], v[3] - v[1]));
    double least = most_added * area;
    std::size_t best = 4;
    double best_way = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 side = v[(i + 1) % 4] - v[i];
        const glm::dvec2 before = v[i] - v[(i + 3) % 4];
        const glm::dvec2 after = v[(i + 1) % 4] - v[(i + 2) % 4];
        const double turn = cross(before, after);
        if (turn == 0)
            continue;
        const double way = cross(side, after) / turn;
        const double added = std::abs(cross(side, before)) * way;
        // The sides meet beyond this one, and not on the quad's other side.
        if (way > 0 && cross(side, before) / turn > 0 && added < least) {
            least = added;
            best = i;
            best_way = way;
        }
    }
    if (best == 4)
        return std::nullopt;
    const glm::dvec2 before = v[best] - v[(best + 3) % 4];
    const glm::dvec2 after = v[(best + 1) % 4] - v[(best + 2) % 4];
    const glm::dvec2 along_before = glm::normalize(before);
    const glm::dvec2 along_after = glm::normalize(after);
    const double sine = std::abs(cross(along_before, along_after));
    if (sine < least_sine)
        return std::nullopt;
    const glm::dvec2 corner =
        (v[best] + best_way * before) * pixels_a_step + (along_before + along_after) * (margin / sine);
    const glm::dvec2 origin = glm::dvec2(at[0]) * pixels_a_step;
    return std::array<glm::vec2, 3>{glm::vec2(origin + corner), glm::vec2(origin + v[(best + 2) % 4] * pixels_a_step),
                                    glm::vec2(origin + v[(best + 3) % 4] * pixels_a_step)};
}

double longest_ray(const Screen& screen)
{
    const glm::dvec2 low = -glm::dvec2(screen.centre());
    const glm::dvec2 high = low + glm::dvec2(screen.size());
    double longest = 0;
    for (const glm::dvec2 corner : {low, high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)})
        longest = std::max(longest, glm::length(screen.rays() * glm::dvec3(corner, 1)));
    return longest;
}

// What is written beside a Thickness.
struct Range {
    float lowest = 0, highest = 0; // scalar
    float reference = 0;           // what the scalars are relative to
    double longest = 0;            // depth, of a way through the cell
    double least_scale = 1;        // of 1 - depth / D
};

} // namespace

struct SilhouetteTriangles::Writer {
    const SilhouetteTriangles& triangles;
    LargeArray<std::byte>& into;
    std::size_t count = 0;
    std::vector<OpticalPass> passes{};

    using Corners = std::array<glm::vec2, 3>;

    std::byte* next()
    {
        const std::size_t bytes = triangles.record_bytes();
        if (into.size() < (count + 1) * bytes)
            into.resize(2 * (count + 1) * bytes);
        return into.data() + count++ * bytes;
    }

    // The triangles with the corners given, in pixels; `at` is where the cell's points are, the first one's place the
    // Thickness' origin.
    void put(const Thickness& t, std::span<const glm::ivec2> at, std::span<const Corners> halves,
             const std::array<glm::vec4, 5>& colours, const Range& range)
    {
        const glm::dvec2 origin = glm::dvec2(at[0]) * triangles.pixels_a_step_;
        const glm::vec2 place = glm::vec2(origin + glm::dvec2(triangles.from_.screen->centre())) + place_offset;
        const double inverse = triangles.inverse_distance_;
        // All that is linear on the screen relative to what 1 - depth / D is at the origin.
        const double scale = 1 / (1 - static_cast<double>(t.depth_base) * inverse);
        const double depth_rise = static_cast<double>(t.swapped ? -t.depth_rise : t.depth_rise) * scale * scale;
        // Parallel rays are all of one length.
        const double a_depth = triangles.perspective_ ? 1 : triangles.longest_ray_;
        std::array<glm::vec4, SilhouetteLayout::most_vectors> vectors;
        std::size_t size = 0;
        vectors[size++] = {t.k1, t.k2};
        if (!triangles.from_.opacity_at_thickest) {
            vectors[size++] = glm::dvec4(a_depth * depth_rise, scale * t.scalar_rise, scale * t.scalar_base,
                                         -scale * inverse * t.depth_rise);
            vectors[size++] = {glm::vec2(scale * glm::dvec2(t.scalar_slope)),
                               glm::vec2(-scale * inverse * glm::dvec2(t.depth_slope))};
        }
        const std::size_t medium = size;
        if (triangles.from_.pieces != nullptr)
            size += 3;
        if (!triangles.from_.optics.empty())
            for (const glm::vec4& colour : colours)
                vectors[size++] = colour;
        const glm::vec4 head(t.kind == SilhouetteClass::quad ? -place.x : place.x, t.swapped ? -place.y : place.y,
                             t.k3);
        const auto write = [&] {
            for (Corners corners : halves) {
                for (glm::vec2& corner : corners)
                    corner /= static_cast<float>(triangles.from_.lattice.half_range);
                triangles.layout_.write(next(), corners, head, std::span(vectors).first(size));
            }
        };
        if (triangles.from_.pieces == nullptr) {
            write();
            return;
        }
        find_optical_passes(*triangles.from_.pieces, ways_of(t, at, range), passes);
        for (const OpticalPass& pass : passes) {
            vectors[medium] = pass.medium;
            vectors[medium + 1] = pass.rise;
            vectors[medium + 2] = pass.window;
            write();
        }
    }

    CellWays ways_of(const Thickness& t, std::span<const glm::ivec2> at, const Range& range) const
    {
        CellWays ways{
            range.lowest,      range.highest,
            range.reference,   range.longest * triangles.longest_ray_ / (range.least_scale * range.least_scale),
            t.scalar_rise > 0, t.scalar_rise < 0,
            t.swapped};
        if (!triangles.perspective_ || triangles.from_.pieces->at(range.lowest).end >= range.highest)
            return ways;
        // Along a ray the scalar rises as a function does that is linear on the screen.
        const double inverse = triangles.inverse_distance_;
        double least_rise = std::numeric_limits<double>::infinity();
        double most_rise = -least_rise;
        for (const glm::ivec2& point : at) {
            const glm::dvec2 r = glm::dvec2(point - at[0]) * triangles.pixels_a_step_;
            const double depth = static_cast<double>(t.depth_base) + glm::dot(glm::dvec2(t.depth_slope), r);
            const double scalar = static_cast<double>(t.scalar_base) + glm::dot(glm::dvec2(t.scalar_slope), r);
            const double rise = static_cast<double>(t.scalar_rise) * (1 - depth * inverse) +
                                static_cast<double>(t.depth_rise) * inverse * scalar;
            least_rise = std::min(least_rise, rise);
            most_rise = std::max(most_rise, rise);
        }
        // Where rounding may decide, both.
        const double doubt = 1e-5 * (std::abs(least_rise) + std::abs(most_rise));
        ways.rises = most_rise > -doubt;
        ways.falls = least_rise < doubt;
        return ways;
    }

    // Makes scalars relative to the first point's, so that they keep their digits.
    Range make_relative(const VisibleCell& cell, CellValues& values) const
    {
        const ScreenPoints& points = triangles.from_.cells->points();
        Range range;
        range.reference = range.lowest = range.highest = points.exact[cell.points[0]].w;
        for (std::size_t i = 0; i < 4; ++i) {
            const float scalar = points.exact[cell.points[i]].w;
            range.lowest = std::min(range.lowest, scalar);
            range.highest = std::max(range.highest, scalar);
            const double scale = 1 - values.depth[i] * triangles.inverse_distance_;
            values.scalar[i] = (static_cast<double>(scalar) - static_cast<double>(range.reference)) * scale;
            range.least_scale = i == 0 ? scale : std::min(range.least_scale, scale);
        }
        return range;
    }

    void put_cell(const VisibleCell& cell)
    {
        CellValues values = values_of(cell, triangles.from_.cells->points(), triangles.inverse_distance_);
        Range range;
        if (triangles.from_.pieces != nullptr)
            range = make_relative(cell, values);
        const Thickness t = thickness_of(cell, values, triangles.pixels_a_step_);
        range.longest = std::abs(static_cast<double>(t.depth_rise));
        std::array<glm::vec4, 5> colours{};
        if (!triangles.from_.optics.empty()) {
            const ThickPoint point = thick_point(cell, values, triangles.pixels_a_step_);
            const CellOptics optics = optics_of(triangles.from_, cell, point);
            colours = t.interpolate(optics.at_points, optics.at_thickest);
        }
        std::array<Corners, 2> halves;
        std::size_t size = 0;
        if (cell.kind == SilhouetteClass::triangle)
            halves[size++] = on_lattice({cell.at[1], cell.at[2], cell.at[3]});
        else if (const auto around = cell.first_half && cell.second_half
                                         ? triangle_around(cell.at, triangles.pixels_a_step_)
                                         : std::nullopt)
            halves[size++] = *around;
        else {
            if (cell.first_half)
                halves[size++] = on_lattice({cell.at[0], cell.at[1], cell.at[2]});
            if (cell.second_half)
                halves[size++] = on_lattice({cell.at[0], cell.at[1], cell.at[3]});
        }
        put(t, cell.at, std::span(halves).first(size), colours, range);
    }

    Corners on_lattice(const std::array<glm::ivec2, 3>& corners) const
    {
        const auto step = static_cast<float>(triangles.pixels_a_step_);
        return {glm::vec2(corners[0]) * step, glm::vec2(corners[1]) * step, glm::vec2(corners[2]) * step};
    }

    void put_slab(const BoundarySlab& slab)
    {
        const std::array<glm::dvec2, 3> corners{glm::dvec2(slab.at[0]) * triangles.pixels_a_step_,
                                                glm::dvec2(slab.at[1]) * triangles.pixels_a_step_,
                                                glm::dvec2(slab.at[2]) * triangles.pixels_a_step_};
        // As a thickness: rise (1 - k.r), with k.r in place of the largest of three.
        constexpr double least_rise = 1e-30;
        const double rise = std::copysign(std::max(std::abs(slab.missing[0]), least_rise), slab.missing[0]);
        std::array<double, 3> scalar = slab.scalar;
        Range range;
        if (triangles.from_.pieces != nullptr) {
            const ScreenPoints& points = triangles.from_.cells->points();
            range.reference = points.exact[slab.face[0]].w;
            range.lowest = range.highest = range.reference;
            for (std::size_t i = 0; i < 3; ++i) {
                range.lowest = std::min(range.lowest, points.exact[slab.face[i]].w);
                range.highest = std::max(range.highest, points.exact[slab.face[i]].w);
                const double scale = 1 - slab.depth[i] * triangles.inverse_distance_;
                scalar[i] -= static_cast<double>(range.reference) * scale;
                range.least_scale = i == 0 ? scale : std::min(range.least_scale, scale);
                range.longest = std::max(range.longest, std::abs(slab.missing[i]));
            }
        }
        Thickness t{};
        t.kind = SilhouetteClass::triangle;
        t.k1 = t.k2 = t.k3 = glm::vec2(-slope_of(corners, slab.missing) / rise);
        t.depth_base = static_cast<float>(slab.depth[0]);
        t.scalar_base = static_cast<float>(scalar[0]);
        t.depth_slope = glm::vec2(slope_of(corners, slab.depth));
        t.scalar_slope = glm::vec2(slope_of(corners, scalar));
        t.depth_rise = static_cast<float>(rise);
        // The scalar hardly changes from the face on the lattice to where it is.
        t.scalar_rise = static_cast<float>(-rise * triangles.inverse_distance_ * scalar[0] /
                                           (1 - slab.depth[0] * triangles.inverse_distance_));
        t.swapped = slab.entry;
        std::array<glm::vec4, 5> colours{};
        if (const auto optics = triangles.from_.optics; !optics.empty()) {
            colours[0] = optics[slab.face[0]];
            for (int k = 0; k < 4; ++k) {
                const glm::dvec2 slope =
                    slope_of(corners, {optics[slab.face[0]][k], optics[slab.face[1]][k], optics[slab.face[2]][k]});
                colours[1][k] = static_cast<float>(slope.x);
                colours[2][k] = static_cast<float>(slope.y);
            }
        }
        put(t, slab.at, std::array<Corners, 1>{on_lattice(slab.at)}, colours, range);
    }
};

SilhouetteTriangles::SilhouetteTriangles(const TriangleSources& sources, Integrator integrator)
    : from_(sources),
      layout_(integrator),
      perspective_(sources.screen->perspective()),
      pixels_a_step_(1.0 / sources.lattice.steps),
      inverse_distance_(sources.screen->inverse_distance()),
      longest_ray_(longest_ray(*sources.screen))
{
}

std::size_t SilhouetteTriangles::make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                                      std::vector<CellOffLattice>& off_lattice) const
{
    into.resize(cells.size() * record_bytes());
    return put_cells_with_slabs(from_, cells, Writer{*this, into}, off_lattice);
}

} // namespace visorder
