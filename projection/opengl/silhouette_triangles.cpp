#include "projection/opengl/silhouette_triangles.h"

#include "projection/opengl/packed_place.h"
#include "projection/optical_passes.h"
#include "projection/outline.h"
#include "projection/split_linear.h"
#include "projection/thickness.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace visorder::detail {

namespace {
} // namespace

struct SilhouetteTriangles::Writer {
    const SilhouetteTriangles& triangles;
    RecordSink& into;
    std::vector<CellApart>& apart;
    std::vector<OpticalPass> passes{};

    // Of more, it is not found out whether the cell covers one.
    static constexpr int most_centres_tried = 8;

    using Corners = std::array<glm::vec2, 3>;
    using Vectors = std::array<glm::vec4, SilhouetteLayout::most_vectors>;

    // What is the same for all of a cell's triangles.
    struct Common {
        glm::vec2 place;
        glm::vec4 shape;
        Vectors vectors; // the first `size` of them
        std::size_t size = 0;

        void add(const glm::vec4& vector) { vectors[size++] = vector; }
    };

    Common common_of(const VisibleCell& cell, const Thickness& t) const
    {
        const PackedPlace place =
            packed_place({cell.at[0].x, cell.at[0].y}, triangles.from_.screen->centre(), t.swapped);
        // Half a pixel from the first point to the middle of its own; farther beyond the cell, rounding does not
        // matter.
        const double reach = cell.longest + 2; // pixels
        const SplitLinear t1 = split_linear(t.slope1, t.first1 - glm::dot(t.slope1, place.beside), reach);
        const SplitLinear t2 = split_linear(t.slope2, -glm::dot(t.slope2, place.beside), reach);
        Common common;
        common.place = place.pixel;
        common.shape = t.shape();
        common.add({t1.high, t2.high});
        common.add({t1.low, t2.low});
        common.add({t1.high_offset, t2.high_offset, t1.low_offset, t2.low_offset});
        if (triangles.linear_)
            return common;
        // All that is linear on the screen relative to what 1 - depth / D is at the thickest point, on the first side.
        const double inverse = triangles.inverse_distance_;
        const double scale = 1 / (1 - t.depth.base * inverse);
        const double depth_rise = (t.swapped ? -t.depth.rise : t.depth.rise) * scale * scale;
        // Parallel rays are all of one length.
        const double a_depth = triangles.perspective_ ? 1 : triangles.longest_ray_;
        common.add(glm::dvec4(a_depth * depth_rise, scale * t.scalar.rise, scale * t.scalar.base,
                              -scale * inverse * t.depth.rise));
        common.add(glm::dvec4(scale * t.scalar.along1, scale * t.scalar.along2, -scale * inverse * t.depth.along1,
                              -scale * inverse * t.depth.along2));
        return common;
    }

    void put(const Common& common, std::span<const Outline::Triangle> outline)
    {
        const RasterLattice& lattice = triangles.from_.cells->lattice();
        const float unit = 1 / (static_cast<float>(lattice.steps) * static_cast<float>(lattice.half_range));
        for (const Outline::Triangle& triangle : outline) {
            const Corners corners{glm::vec2(triangle[0]) * unit, glm::vec2(triangle[1]) * unit,
                                  glm::vec2(triangle[2]) * unit};
            triangles.layout_.write(into.next(), corners, common.place, common.shape,
                                    std::span(common.vectors).first(common.size));
        }
    }

    CellWays ways_of(const VisibleCell& cell, const Thickness& t) const
    {
        const double inverse = triangles.inverse_distance_;
        const ScaledScalars& scalars = triangles.from_.scalars;
        CellWays ways{};
        ways.reference = ways.lowest = ways.highest = scalars[cell.points[0]];
        for (std::size_t i = 0; i < 4; ++i) {
            const double scalar = scalars[cell.points[i]];
            ways.lowest = std::min(ways.lowest, scalar);
            ways.highest = std::max(ways.highest, scalar);
        }
        const double least_scale = 1 - cell.farthest * inverse;
        ways.longest = std::abs(t.depth.rise) * triangles.longest_ray_ / (least_scale * least_scale);
        // Less does not count to fragments.
        constexpr double least_rise_that_counts = 1e-24;
        ways.rises = t.scalar.rise > -least_rise_that_counts;
        ways.falls = t.scalar.rise < least_rise_that_counts;
        ways.swapped = t.swapped;
        if (!triangles.perspective_ || triangles.from_.pieces->at(ways.lowest).end >= ways.highest)
            return ways;
        // Along a ray the scalar rises as a function does that is linear on the screen.
        double least_rise = std::numeric_limits<double>::infinity();
        double most_rise = -least_rise;
        for (const glm::dvec3& point : cell.at) {
            const glm::dvec2 r(point.x - cell.at[0].x, point.y - cell.at[0].y);
            const double t1 = t.first1 + glm::dot(t.slope1, r);
            const double t2 = glm::dot(t.slope2, r);
            const double depth = t.depth.base + t.depth.along1 * t1 + t.depth.along2 * t2;
            const double scalar = t.scalar.base + t.scalar.along1 * t1 + t.scalar.along2 * t2;
            const double rise = t.scalar.rise * (1 - depth * inverse) + t.depth.rise * inverse * scalar;
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
        const ScaledScalars& scalars = triangles.from_.scalars;
        const double reference = scalars[cell.points[0]];
        for (std::size_t i = 0; i < 4; ++i)
            values.scalar[i] =
                (scalars[cell.points[i]] - reference) * (1 - values.depth[i] * triangles.inverse_distance_);
    }

    // Whether the cell, if it is small, covers the centre of a pixel.
    bool covers_a_centre(const VisibleCell& cell, const Thickness& t) const
    {
        const VisibleCells::Pixels pixels = triangles.from_.cells->pixels_in(cell.low, cell.high);
        if (pixels.none())
            return false;
        const glm::ivec2 size = pixels.last - pixels.first + 1;
        if (size.x > most_centres_tried || size.y > most_centres_tried || size.x * size.y > most_centres_tried)
            return true;
        for (int y = pixels.first.y; y <= pixels.last.y; ++y)
            for (int x = pixels.first.x; x <= pixels.last.x; ++x)
                if (t.at({x + 0.5 - cell.at[0].x, y + 0.5 - cell.at[0].y}) > 0)
                    return true;
        return false;
    }

    void set_apart(CellId cell) { apart.push_back({static_cast<std::uint32_t>(into.count()), cell}); }

    void put_cell(const VisibleCell& cell)
    {
        const TriangleSources& from = triangles.from_;
        const RasterLattice& lattice = from.cells->lattice();
        CellValues values = values_of(cell, from.scalars, triangles.inverse_distance_);
        if (from.pieces != nullptr)
            make_relative(cell, values);
        const Thickness t = thickness_of(cell, values);
        if (!covers_a_centre(cell, t))
            return;
        const Outline outline =
            triangles.fans_ ? fan_of(cell, thick_point(cell, values).at, lattice) : outline_of(cell, lattice);
        std::array<Outline::Triangle, 4> seen; // the first `seen_count` of them
        std::size_t seen_count = 0;
        for (const Outline::Triangle& triangle : outline.triangles())
            if (from.cells->may_cover(triangle))
                seen[seen_count++] = triangle;
        if (seen_count == 0)
            return;
        const std::span<const Outline::Triangle> drawn = std::span(seen).first(seen_count);
        Common common = common_of(cell, t);
        if (from.pieces != nullptr) {
            if (!find_optical_passes(*from.pieces, ways_of(cell, t), passes)) {
                set_apart(cell.cell);
                return;
            }
            const std::size_t size = common.size;
            for (const OpticalPass& pass : passes) {
                common.size = size;
                for (const glm::vec4& vector : {pass.medium, pass.rise, pass.window})
                    common.add(vector);
                put(common, drawn);
            }
            return;
        }
        if (!from.optics.empty()) {
            std::array<glm::vec4, 5> colours =
                t.interpolate({from.optics[cell.points[0]], from.optics[cell.points[1]], from.optics[cell.points[2]],
                               from.optics[cell.points[3]]});
            if (from.opacity_at_thickest)
                colours[0].w = opacity_of(colours[0].w * static_cast<float>(length_at_thickest(cell, t)));
            for (const glm::vec4& colour : colours)
                common.add(colour);
        }
        put(common, drawn);
    }

    double length_at_thickest(const VisibleCell& cell, const Thickness& t) const
    {
        const double inverse = triangles.inverse_distance_;
        const double way =
            std::abs(t.depth.rise) / ((1 - t.depth.base * inverse) * (1 - (t.depth.base + t.depth.rise) * inverse));
        if (!triangles.perspective_)
            return way * triangles.longest_ray_;
        glm::dvec2 at(cell.at[0].x, cell.at[0].y);
        if (t.kind == SilhouetteClass::quad)
            at += t.along_first * (glm::dvec2(cell.at[1].x, cell.at[1].y) - at);
        return way * glm::length(triangles.from_.screen->rays() * glm::dvec3(at, 1));
    }

    // 1 - exp(-depth), mostly of little depth.
    static float opacity_of(float depth)
    {
        constexpr float little = 0.1F;
        if (depth > little)
            return 1 - std::exp(-depth);
        return depth * (1 - depth / 2 * (1 - depth / 3 * (1 - depth / 4 * (1 - depth / 5))));
    }
};

SilhouetteTriangles::SilhouetteTriangles(const TriangleSources& sources, Integrator integrator, bool fans)
    : from_(sources),
      layout_(integrator, sources.pieces != nullptr),
      fans_(fans),
      linear_(integrator == Integrator::linear),
      perspective_(sources.screen->perspective()),
      inverse_distance_(sources.screen->inverse_distance()),
      longest_ray_(sources.screen->longest_ray())
{
}

void SilhouetteTriangles::make(std::span<const CellId> cells, RecordSink& into, std::vector<CellApart>& apart) const
{
    Writer writer{*this, into, apart};
    from_.cells->visit(
        cells, [&](const VisibleCell& cell) { writer.put_cell(cell); }, [&](CellId cell) { writer.set_apart(cell); });
}

} // namespace visorder::detail
