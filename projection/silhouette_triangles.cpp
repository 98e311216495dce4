#include "projection/silhouette_triangles.h"

#include "projection/outline.h"
#include "projection/thickness.h"

#include <cmath>
#include <cstring>

namespace visorder {

namespace {

// What the vertex shader reads, in floats: see projector_shaders.cpp.
constexpr std::size_t plain_floats = 24;
constexpr std::size_t optics_floats = 20;
// Added to a place, in pixels, so that its coordinates are positive and their signs can say something else.
constexpr float place_offset = 16384;

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

    void put(const Thickness& t, const glm::dvec3& origin, const Outline::Triangle& corners,
             const std::array<glm::vec4, 5>& colours)
    {
        const double steps = triangles.from_.cells->lattice().steps;
        // In two parts, of which single precision holds the first exactly.
        const glm::dvec2 place(origin.x, origin.y);
        const glm::dvec2 on_lattice(std::round(place.x * steps) / steps, std::round(place.y * steps) / steps);
        const glm::vec2 positive = glm::vec2(on_lattice) + place_offset;
        put(t.kind == SilhouetteClass::quad ? -positive.x : positive.x);
        put(t.swapped ? -positive.y : positive.y);
        put(t.depth.rise);
        put(t.scalar.rise);
        put(t.k1);
        put(t.k2);
        put(t.k3);
        put(t.depth.base);
        put(t.scalar.base);
        put(t.depth.slope);
        put(t.scalar.slope);
        for (const glm::ivec2& corner : corners)
            put(glm::vec2(corner) / static_cast<float>(steps));
        put(glm::vec2(place - on_lattice));
        if (!triangles.from_.optics.empty()) {
            std::memcpy(next, colours.data(), sizeof colours);
            next += optics_floats;
        }
        ++count;
    }

    void put_cell(const VisibleCell& cell)
    {
        const TriangleSources& from = triangles.from_;
        const RasterLattice& lattice = from.cells->lattice();
        const CellValues values = values_of(cell, from.scalars, from.screen->inverse_distance());
        const Outline outline =
            triangles.fans_ ? fan_of(cell, thick_point(cell, values).at, lattice) : outline_of(cell, lattice);
        bool ready = false;
        Thickness t{};
        std::array<glm::vec4, 5> colours{};
        for (const Outline::Triangle& triangle : outline.triangles()) {
            if (!from.cells->covers_a_centre(triangle))
                continue;
            if (!ready) {
                t = thickness_of(cell, values);
                if (!from.optics.empty()) {
                    const CellOptics optics = optics_of(from, cell, thick_point(cell, values));
                    colours = t.interpolate(optics.at_points, optics.at_thickest);
                }
                ready = true;
            }
            put(t, cell.at[0], triangle, colours);
        }
    }
};

SilhouetteTriangles::SilhouetteTriangles(const TriangleSources& sources, bool fans) : from_(sources), fans_(fans) {}

std::size_t SilhouetteTriangles::triangle_bytes() const
{
    return (plain_floats + (from_.optics.empty() ? 0 : optics_floats)) * sizeof(float);
}

std::size_t SilhouetteTriangles::make(std::span<const CellId> cells, std::byte* into,
                                      std::vector<CellApart>& apart) const
{
    Writer writer{*this, reinterpret_cast<float*>(into)};
    from_.cells->visit(
        cells, [&](const VisibleCell& cell) { writer.put_cell(cell); },
        [&](CellId cell) {
            apart.push_back({static_cast<std::uint32_t>(writer.count), cell});
        });
    return writer.count;
}

} // namespace visorder
