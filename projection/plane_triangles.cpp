#include "projection/plane_triangles.h"

#include "projection/outline.h"
#include "projection/packed_place.h"
#include "projection/thickness.h"

#include <cstring>

namespace visorder {

namespace {

// What the vertex shader reads: see projector_shaders.cpp.
struct PlaneRecord {
    PackedPlace place;    // from the image's centre
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

glm::vec4 packed(const Thickness::Linear& linear)
{
    return {linear.base, linear.slope, linear.rise};
}

// In units of the rise. Of a triangle: the face of the outer points, and the three others. Of a quad: the two faces at
// the nearer edge, and the two at the farther one.
void put_planes(PlaneRecord& record, const Thickness& t)
{
    const auto put = [&](int i, float offset, const glm::vec2& slope) {
        record.offset[i] = offset;
        record.slope_x[i] = slope.x;
        record.slope_y[i] = slope.y;
    };
    if (t.kind == SilhouetteClass::triangle) {
        put(0, 0, glm::vec2(0));
        put(1, 1, -t.k1);
        put(2, 1, -t.k2);
        put(3, 1, -t.k3);
    } else {
        put(0, 0, t.k2);
        put(1, 0, t.k3.y * t.k2);
        put(2, 0, -t.k1);
        put(3, 1 - t.k3.x, -t.k3.x * t.k1);
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
        const Thickness::Linear linear = t.linear(values);
        optics.base[channel] = linear.base;
        optics.slope_x[channel] = linear.slope.x;
        optics.slope_y[channel] = linear.slope.y;
        optics.rise[channel] = linear.rise;
    }
    return optics;
}

} // namespace

struct PlaneTriangles::Writer {
    const TriangleSources& from;
    std::byte* next;
    std::size_t count = 0;

    template <class Data>
    void put(const Data& data)
    {
        std::memcpy(next, &data, sizeof data);
        next += sizeof data;
    }

    void put_cell(const VisibleCell& cell)
    {
        const RasterLattice& lattice = from.cells->lattice();
        const Outline outline = outline_of(cell, lattice);
        bool ready = false;
        PlaneRecord record{};
        PlaneOptics optics{};
        for (const Outline::Triangle& triangle : outline.triangles()) {
            if (!from.cells->covers_a_centre(triangle))
                continue;
            if (!ready) {
                const Thickness t = thickness_of(cell, values_of(cell, from.scalars, from.screen->inverse_distance()));
                record.place = packed_place({cell.at[0].x, cell.at[0].y}, glm::ivec2(0), lattice, t.kind, t.swapped);
                record.depth = packed(t.depth);
                record.scalar = packed(t.scalar);
                put_planes(record, t);
                if (!from.optics.empty())
                    optics = optics_of(from, cell, t);
                ready = true;
            }
            for (std::size_t i = 0; i < 3; ++i)
                record.corners[i] = glm::vec2(triangle[i]) / static_cast<float>(lattice.steps);
            put(record);
            if (!from.optics.empty())
                put(optics);
            ++count;
        }
    }
};

std::size_t PlaneTriangles::record_bytes() const
{
    return sizeof(PlaneRecord) + (from_.optics.empty() ? 0 : sizeof(PlaneOptics));
}

std::size_t PlaneTriangles::make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                                 std::vector<CellApart>& apart) const
{
    constexpr std::size_t most_a_cell = 2;
    into.resize(cells.size() * most_a_cell * record_bytes());
    Writer writer{from_, into.data()};
    from_.cells->visit(
        cells, [&](const VisibleCell& cell) { writer.put_cell(cell); },
        [&](CellId cell) {
            apart.push_back({static_cast<std::uint32_t>(writer.count), cell});
        });
    return writer.count;
}

} // namespace visorder
