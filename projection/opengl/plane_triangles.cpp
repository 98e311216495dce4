#include "projection/opengl/plane_triangles.h"

#include "projection/opengl/packed_place.h"
#include "projection/outline.h"
#include "projection/split_linear.h"
#include "projection/thickness.h"

#include <cstring>
#include <glm/geometric.hpp>

namespace visorder::detail {

namespace {

// What the vertex shader reads: see projector_shaders.cpp.
struct PlaneRecord {
    glm::vec4 place;        // see PackedPlace, from the image's centre; x is negative of a quad
    glm::vec4 tents_high;   // of t1 and t2, see SplitLinear
    glm::vec4 tents_low;    // likewise
    glm::vec4 tent_offsets; // likewise, high and low
    glm::vec4 shape;        // see Thickness
    glm::vec4 depth;        // see Thickness::Linear
    glm::vec4 scalar;       // likewise
    glm::vec2 corners[3];   // of the triangle
    glm::vec2 unused{0};
};

// Colour and extinction times 1 - depth / D; see Thickness::Linear.
struct PlaneOptics {
    glm::vec4 base, along1, along2, rise;
};

glm::vec4 packed(const Thickness::Linear& linear)
{
    return {linear.base, linear.along1, linear.along2, linear.rise};
}

PlaneRecord record_of(const VisibleCell& cell, const Thickness& t)
{
    const PackedPlace place = packed_place({cell.at[0].x, cell.at[0].y}, glm::ivec2(0), t.swapped);
    const double reach = cell.longest + 2; // pixels
    const SplitLinear t1 = split_linear(t.slope1, t.first1 - glm::dot(t.slope1, place.beside), reach);
    const SplitLinear t2 = split_linear(t.slope2, -glm::dot(t.slope2, place.beside), reach);
    PlaneRecord record{};
    record.place = {t.kind == SilhouetteClass::quad ? -place.pixel.x : place.pixel.x, place.pixel.y, 0, 0};
    record.tents_high = {t1.high, t2.high};
    record.tents_low = {t1.low, t2.low};
    record.tent_offsets = {t1.high_offset, t2.high_offset, t1.low_offset, t2.low_offset};
    record.shape = t.shape();
    record.depth = packed(t.depth);
    record.scalar = packed(t.scalar);
    return record;
}

PlaneOptics optics_of(const TriangleSources& from, const VisibleCell& cell, const Thickness& t)
{
    PlaneOptics optics{};
    for (int channel = 0; channel < 4; ++channel) {
        std::array<double, 4> values{};
        for (std::size_t i = 0; i < 4; ++i)
            values[i] = static_cast<double>(from.optics[cell.points[i]][channel]) *
                        (1 - cell.at[i].z * from.screen->inverse_distance());
        const glm::vec4 linear = packed(t.linear(values));
        optics.base[channel] = linear.x;
        optics.along1[channel] = linear.y;
        optics.along2[channel] = linear.z;
        optics.rise[channel] = linear.w;
    }
    return optics;
}

} // namespace

struct PlaneTriangles::Writer {
    const TriangleSources& from;
    RecordSink& into;
    std::vector<CellApart>& apart;

    void set_apart(CellId cell) { apart.push_back({static_cast<std::uint32_t>(into.count()), cell}); }

    void put_cell(const VisibleCell& cell)
    {
        if (from.pieces != nullptr && !single_precision_is_enough(cell, from)) {
            set_apart(cell.cell);
            return;
        }
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
                record = record_of(cell, t);
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
    Writer writer{from_, into, apart};
    from_.cells->visit(
        cells, [&](const VisibleCell& cell) { writer.put_cell(cell); }, [&](CellId cell) { writer.set_apart(cell); });
}

} // namespace visorder::detail
