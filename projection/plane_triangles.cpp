#include "projection/plane_triangles.h"

#include "projection/outline.h"
#include "projection/packed_place.h"
#include "projection/thickness.h"

#include <cstring>

namespace visorder {

namespace {

// What the vertex shader reads: see projector_shaders.cpp.
struct PlaneRecord {
    glm::vec2 pixel; // see PackedPlace, from the image's centre; x is negative of a quad
    glm::vec2 beside;
    glm::vec4 depth;      // base, slope, rise
    glm::vec4 scalar;     // likewise
    glm::vec4 offset;     // of four planes
    glm::vec4 slope_x;    // likewise
    glm::vec4 slope_y;    // likewise
    glm::vec2 corners[3]; // of the triangle
    glm::vec2 unused{0};
};

// Colour and extinction times 1 - depth / D: base, slopes, rise.
struct PlaneOptics {
    glm::vec4 base, slope_x, slope_y, rise;
};

// Over pixels from the cell's first point.
glm::vec4 packed(const Thickness& t, const Thickness::Linear& linear)
{
    return {linear.base + linear.along1 * t.first1, linear.along1 * t.slope1 + linear.along2 * t.slope2, linear.rise};
}

// In units of the rise. Of a triangle: the face of the outer points, and the three others. Of a quad: the two faces at
// the nearer edge, and the two at the farther one.
void put_planes(PlaneRecord& record, const Thickness& t)
{
    const auto put = [&](int i, double offset, const glm::dvec2& slope) {
        record.offset[i] = static_cast<float>(offset);
        record.slope_x[i] = static_cast<float>(slope.x);
        record.slope_y[i] = static_cast<float>(slope.y);
    };
    if (t.kind == SilhouetteClass::triangle) {
        put(0, 0, glm::dvec2(0));
        put(1, 1, -t.slope1);
        put(2, 1, -t.slope2);
        put(3, 1, -t.third.x * t.slope1 - t.third.y * t.slope2);
    } else {
        put(0, 0, t.slope2);
        put(1, 0, t.opposite * t.slope2);
        put(2, 0, -t.slope1);
        put(3, 1 - t.third.x, -t.third.x * t.slope1);
    }
}

PlaneOptics optics_of(const TriangleSources& from, const VisibleCell& cell, const Thickness& t)
{
    PlaneOptics optics{};
    for (int channel = 0; channel < 4; ++channel) {
        std::array<double, 4> values{};
        for (std::size_t i = 0; i < 4; ++i)
            values[i] = static_cast<double>(from.optics[cell.points[i]][channel]) *
                        (1 - cell.at[i].z * from.screen->inverse_distance());
        const glm::vec4 linear = packed(t, t.linear(values));
        optics.base[channel] = linear.x;
        optics.slope_x[channel] = linear.y;
        optics.slope_y[channel] = linear.z;
        optics.rise[channel] = linear.w;
    }
    return optics;
}

} // namespace

struct PlaneTriangles::Writer {
    const TriangleSources& from;
    RecordSink& into;

    void put_cell(const VisibleCell& cell)
    {
        const RasterLattice& lattice = from.cells->lattice();
        const Outline outline = outline_of(cell, lattice);
        bool ready = false;
        PlaneRecord record{};
        PlaneOptics optics{};
        for (const Outline::Triangle& triangle : outline.triangles()) {
            if (!from.cells->may_cover(triangle))
                continue;
            if (!ready) {
                const Thickness t = thickness_of(cell, values_of(cell, from.scalars, from.screen->inverse_distance()));
                const PackedPlace place = packed_place({cell.at[0].x, cell.at[0].y}, glm::ivec2(0), t.swapped);
                record.pixel = t.kind == SilhouetteClass::quad ? glm::vec2(-place.pixel.x, place.pixel.y) : place.pixel;
                record.beside = glm::vec2(place.beside);
                record.depth = packed(t, t.depth);
                record.scalar = packed(t, t.scalar);
                put_planes(record, t);
                if (!from.optics.empty())
                    optics = optics_of(from, cell, t);
                ready = true;
            }
            for (std::size_t i = 0; i < 3; ++i)
                record.corners[i] = glm::vec2(triangle[i]) / static_cast<float>(lattice.steps);
            std::byte* const next = into.next();
            std::memcpy(next, &record, sizeof record);
            if (!from.optics.empty())
                std::memcpy(next + sizeof record, &optics, sizeof optics);
        }
    }
};

std::size_t PlaneTriangles::record_bytes() const
{
    return sizeof(PlaneRecord) + (from_.optics.empty() ? 0 : sizeof(PlaneOptics));
}

void PlaneTriangles::make(std::span<const CellId> cells, RecordSink& into, std::vector<CellApart>& apart) const
{
    Writer writer{from_, into};
    from_.cells->visit(
        cells, [&](const VisibleCell& cell) { writer.put_cell(cell); },
        [&](CellId cell) {
            apart.push_back({static_cast<std::uint32_t>(into.count()), cell});
        });
}

} // namespace visorder
