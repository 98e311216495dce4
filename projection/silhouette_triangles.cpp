#include "projection/silhouette_triangles.h"

#include "projection/thickness.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <optional>

namespace visorder {

namespace {

// What the vertex shader reads, in floats: see projector_shaders.cpp.
constexpr std::size_t plain_floats = 24;
constexpr std::size_t optics_floats = 20;
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

} // namespace

struct SilhouetteTriangles::Writer {
    const SilhouetteTriangles& triangles;
    float* next;
    std::size_t count = 0;

    void put(float value) { *next++ = value; }
    void put(const glm::vec2& value)
    {
        put(value.x);
        put(value.y);
    }

    // One triangle with the corners given, in pixels.
    void put(const Thickness& t, const glm::ivec2& reference, const std::array<glm::vec2, 3>& corners,
             const std::array<glm::vec4, 5>& colours)
    {
        const auto step = static_cast<float>(triangles.pixels_a_step_);
        const glm::vec2 place = glm::vec2(reference) * step + place_offset;
        put(t.kind == SilhouetteClass::quad ? -place.x : place.x);
        put(t.swapped ? -place.y : place.y);
        put(t.depth_rise);
        put(t.scalar_rise);
        put(t.k1);
        put(t.k2);
        put(t.k3);
        put(t.depth_base);
        put(t.scalar_base);
        put(t.depth_slope);
        put(t.scalar_slope);
        for (const glm::vec2& corner : corners)
            put(corner);
        put(glm::vec2(0));
        if (!triangles.from_.optics.empty()) {
            std::memcpy(next, colours.data(), sizeof colours);
            next += optics_floats;
        }
        ++count;
    }

    void put_cell(const VisibleCell& cell)
    {
        const CellValues values = values_of(cell, triangles.from_.cells->points(), triangles.inverse_distance_);
        const Thickness t = thickness_of(cell, values, triangles.pixels_a_step_);
        std::array<glm::vec4, 5> colours{};
        if (!triangles.from_.optics.empty()) {
            const ThickPoint point = thick_point(cell, values, triangles.pixels_a_step_);
            const CellOptics optics = optics_of(triangles.from_, cell, point);
            colours = t.interpolate(optics.at_points, optics.at_thickest);
        }
        if (cell.kind == SilhouetteClass::triangle) {
            put(t, cell.at[0], on_lattice({cell.at[1], cell.at[2], cell.at[3]}), colours);
            return;
        }
        if (cell.first_half && cell.second_half)
            if (const auto around = triangle_around(cell.at, triangles.pixels_a_step_)) {
                put(t, cell.at[0], *around, colours);
                return;
            }
        if (cell.first_half)
            put(t, cell.at[0], on_lattice({cell.at[0], cell.at[1], cell.at[2]}), colours);
        if (cell.second_half)
            put(t, cell.at[0], on_lattice({cell.at[0], cell.at[1], cell.at[3]}), colours);
    }

    std::array<glm::vec2, 3> on_lattice(const std::array<glm::ivec2, 3>& corners) const
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
        Thickness t{};
        t.kind = SilhouetteClass::triangle;
        t.k1 = t.k2 = t.k3 = glm::vec2(-slope_of(corners, slab.missing) / rise);
        t.depth_base = static_cast<float>(slab.depth[0]);
        t.scalar_base = static_cast<float>(slab.scalar[0]);
        t.depth_slope = glm::vec2(slope_of(corners, slab.depth));
        t.scalar_slope = glm::vec2(slope_of(corners, slab.scalar));
        t.depth_rise = static_cast<float>(rise);
        // The scalar hardly changes from the face on the lattice to where it is.
        t.scalar_rise = static_cast<float>(-rise * triangles.inverse_distance_ * slab.scalar[0] /
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
        put(t, slab.at[0], on_lattice(slab.at), colours);
    }
};

SilhouetteTriangles::SilhouetteTriangles(const TriangleSources& sources)
    : from_(sources), pixels_a_step_(1.0 / sources.lattice.steps), inverse_distance_(sources.screen->inverse_distance())
{
}

std::size_t SilhouetteTriangles::triangle_bytes() const
{
    return (plain_floats + (from_.optics.empty() ? 0 : optics_floats)) * sizeof(float);
}

std::size_t SilhouetteTriangles::make(std::span<const CellId> cells, std::byte* into,
                                      std::vector<CellOffLattice>& off_lattice) const
{
    return put_cells_with_slabs(from_, cells, Writer{*this, reinterpret_cast<float*>(into)}, off_lattice);
}

} // namespace visorder
