#include "projection/silhouette_triangles.h"

#include "projection/optical_passes.h"
#include "projection/outline.h"
#include "projection/packed_place.h"
#include "projection/thickness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace visorder {

namespace {

double longest_ray(const Screen& screen)
{
    const glm::dvec2 low = -glm::dvec2(screen.centre());
    const glm::dvec2 high = low + glm::dvec2(screen.size());
    double longest = 0;
    for (const glm::dvec2 corner : {low, high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)})
        longest = std::max(longest, glm::length(screen.rays() * glm::dvec3(corner, 1)));
    return longest;
}

} // namespace

struct SilhouetteTriangles::Writer {
    const SilhouetteTriangles& triangles;
    LargeArray<std::byte>& into;
    std::size_t count = 0;
    std::vector<OpticalPass> passes{};

    using Corners = std::array<glm::vec2, 3>;
    using Vectors = std::array<glm::vec4, SilhouetteLayout::most_vectors>;

    std::byte* next()
    {
        const std::size_t bytes = triangles.record_bytes();
        if (into.size() < (count + 1) * bytes)
            into.resize(2 * (count + 1) * bytes);
        return into.data() + count++ * bytes;
    }

    // What is the same for all of a cell's triangles.
    struct Common {
        glm::vec4 place{};
        glm::vec2 beside{};
        Vectors vectors{};
        std::size_t size = 0;
    };

    Common common_of(const VisibleCell& cell, const Thickness& t) const
    {
        const PackedPlace place = packed_place({cell.at[0].x, cell.at[0].y}, triangles.from_.screen->centre(),
                                               triangles.from_.cells->lattice(), t.kind, t.swapped);
        Common common;
        common.place = glm::vec4(place.on_lattice, t.k3);
        common.beside = place.beside;
        common.vectors[common.size++] = {t.k1, t.k2};
        if (triangles.linear_)
            return common;
        // All that is linear on the screen relative to what 1 - depth / D is at the origin.
        const double inverse = triangles.inverse_distance_;
        const double scale = 1 / (1 - static_cast<double>(t.depth.base) * inverse);
        const double depth_rise = static_cast<double>(t.swapped ? -t.depth.rise : t.depth.rise) * scale * scale;
        // Parallel rays are all of one length.
        const double a_depth = triangles.perspective_ ? 1 : triangles.longest_ray_;
        common.vectors[common.size++] = glm::dvec4(a_depth * depth_rise, scale * t.scalar.rise, scale * t.scalar.base,
                                                   -scale * inverse * t.depth.rise);
        common.vectors[common.size++] = {glm::vec2(scale * glm::dvec2(t.scalar.slope)),
                                         glm::vec2(-scale * inverse * glm::dvec2(t.depth.slope))};
        return common;
    }

    void put(const Common& common, std::span<const Outline::Triangle> outline)
    {
        const RasterLattice& lattice = triangles.from_.cells->lattice();
        const float unit = 1 / (static_cast<float>(lattice.steps) * static_cast<float>(lattice.half_range));
        for (const Outline::Triangle& triangle : outline) {
            const Corners corners{glm::vec2(triangle[0]) * unit, glm::vec2(triangle[1]) * unit,
                                  glm::vec2(triangle[2]) * unit};
            triangles.layout_.write(next(), corners, common.place, common.beside,
                                    std::span(common.vectors).first(common.size));
        }
    }

    CellWays ways_of(const VisibleCell& cell, const CellValues& values, const Thickness& t) const
    {
        const double inverse = triangles.inverse_distance_;
        const std::span<const float> scalars = triangles.from_.scalars;
        CellWays ways{};
        ways.reference = ways.lowest = ways.highest = scalars[cell.points[0]];
        double least_scale = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < 4; ++i) {
            ways.lowest = std::min(ways.lowest, scalars[cell.points[i]]);
            ways.highest = std::max(ways.highest, scalars[cell.points[i]]);
            least_scale = std::min(least_scale, 1 - values.depth[i] * inverse);
        }
        ways.longest =
            std::abs(static_cast<double>(t.depth.rise)) * triangles.longest_ray_ / (least_scale * least_scale);
        ways.rises = t.scalar.rise > 0;
        ways.falls = t.scalar.rise < 0;
        ways.swapped = t.swapped;
        if (!triangles.perspective_ || triangles.from_.pieces->at(ways.lowest).end >= ways.highest)
            return ways;
        // Along a ray the scalar rises as a function does that is linear on the screen.
        double least_rise = std::numeric_limits<double>::infinity();
        double most_rise = -least_rise;
        for (const glm::dvec3& point : cell.at) {
            const glm::dvec2 r(point.x - cell.at[0].x, point.y - cell.at[0].y);
            const double depth = static_cast<double>(t.depth.base) + glm::dot(glm::dvec2(t.depth.slope), r);
            const double scalar = static_cast<double>(t.scalar.base) + glm::dot(glm::dvec2(t.scalar.slope), r);
            const double rise = static_cast<double>(t.scalar.rise) * (1 - depth * inverse) +
                                static_cast<double>(t.depth.rise) * inverse * scalar;
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
    void make_relative(const VisibleCell& cell, CellValues& values) const
    {
        const std::span<const float> scalars = triangles.from_.scalars;
        const double reference = scalars[cell.points[0]];
        for (std::size_t i = 0; i < 4; ++i)
            values.scalar[i] = (static_cast<double>(scalars[cell.points[i]]) - reference) *
                               (1 - values.depth[i] * triangles.inverse_distance_);
    }

    void put_cell(const VisibleCell& cell)
    {
        const TriangleSources& from = triangles.from_;
        const RasterLattice& lattice = from.cells->lattice();
        CellValues values = values_of(cell, from.scalars, triangles.inverse_distance_);
        const Outline outline =
            triangles.fans_ ? fan_of(cell, thick_point(cell, values).at, lattice) : outline_of(cell, lattice);
        std::array<Outline::Triangle, 4> seen{};
        std::size_t seen_count = 0;
        for (const Outline::Triangle& triangle : outline.triangles())
            if (from.cells->covers_a_centre(triangle))
                seen[seen_count++] = triangle;
        if (seen_count == 0)
            return;
        const std::span<const Outline::Triangle> drawn = std::span(seen).first(seen_count);
        if (from.pieces != nullptr)
            make_relative(cell, values);
        const Thickness t = thickness_of(cell, values);
        Common common = common_of(cell, t);
        if (from.pieces != nullptr) {
            find_optical_passes(*from.pieces, ways_of(cell, values, t), passes);
            const std::size_t size = common.size;
            for (const OpticalPass& pass : passes) {
                common.size = size;
                for (const glm::vec4& vector : {pass.medium, pass.rise, pass.window})
                    common.vectors[common.size++] = vector;
                put(common, drawn);
            }
            return;
        }
        if (!from.optics.empty()) {
            const CellOptics optics = optics_of(from, cell, thick_point(cell, values));
            for (const glm::vec4& colour : t.interpolate(optics.at_points, optics.at_thickest))
                common.vectors[common.size++] = colour;
        }
        put(common, drawn);
    }
};

SilhouetteTriangles::SilhouetteTriangles(const TriangleSources& sources, Integrator integrator, bool fans)
    : from_(sources),
      layout_(integrator, sources.pieces != nullptr),
      fans_(fans),
      linear_(integrator == Integrator::linear),
      perspective_(sources.screen->perspective()),
      inverse_distance_(sources.screen->inverse_distance()),
      longest_ray_(longest_ray(*sources.screen))
{
}

std::size_t SilhouetteTriangles::make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                                      std::vector<CellApart>& apart) const
{
    into.resize(cells.size() * record_bytes());
    Writer writer{*this, into};
    from_.cells->visit(
        cells, [&](const VisibleCell& cell) { writer.put_cell(cell); },
        [&](CellId cell) {
            apart.push_back({static_cast<std::uint32_t>(writer.count), cell});
        });
    return writer.count;
}

} // namespace visorder
