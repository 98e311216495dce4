#include "projection/thick_triangles.h"

#include "projection/thickness.h"

#include <cstring>

namespace visorder {

namespace {

// What the vertex shader reads of a corner: see projector_shaders.cpp.
struct Corner {
    glm::vec2 place;
    glm::vec2 front, back; // depth, and scalar times 1 - depth / D
    glm::vec2 unused{0};
};
constexpr std::size_t plain_bytes = sizeof(Corner);
constexpr std::size_t optics_bytes = sizeof(glm::vec4);

} // namespace

struct ThickTriangles::Writer {
    const TriangleSources& from;
    std::byte* next;
    std::size_t count = 0;

    void put(const Corner& corner, const glm::vec4& optics)
    {
        std::memcpy(next, &corner, plain_bytes);
        next += plain_bytes;
        if (!from.optics.empty()) {
            std::memcpy(next, &optics, optics_bytes);
            next += optics_bytes;
        }
    }

    void put_cell(const VisibleCell& cell)
    {
        const double step = 1.0 / from.lattice.steps;
        const CellValues values = values_of(cell, from.cells->points(), from.screen->inverse_distance());
        const ThickPoint point = thick_point(cell, values, step);
        CellOptics optics{};
        if (!from.optics.empty())
            optics = optics_of(from, cell, point);
        const Corner thickest{glm::vec2(glm::dvec2(cell.at[0]) * step + point.at),
                              {point.front_depth, point.front_scalar},
                              {point.back_depth, point.back_scalar}};
        const auto put_corner = [&](std::size_t i) {
            const glm::vec2 value(values.depth[i], values.scalar[i]);
            put({glm::vec2(glm::dvec2(cell.at[i]) * step), value, value}, optics.at_points[i]);
        };
        const auto put_triangle = [&](std::size_t a, std::size_t b) {
            put(thickest, optics.at_thickest);
            put_corner(a);
            put_corner(b);
            ++count;
        };
        if (cell.kind == SilhouetteClass::triangle) {
            for (std::size_t i = 0; i < 3; ++i)
                if (from.cells->covers_a_centre(cell.at[0], cell.at[1 + i], cell.at[1 + (i + 1) % 3]))
                    put_triangle(1 + i, 1 + (i + 1) % 3);
            return;
        }
        for (std::size_t a = 0; a < 2; ++a)
            for (std::size_t b = 2; b < 4; ++b)
                put_triangle(a, b);
    }

    void put_slab(const BoundarySlab& slab)
    {
        for (std::size_t i = 0; i < 3; ++i) {
            const double inverse = from.screen->inverse_distance();
            const glm::vec2 on_lattice(slab.depth[i], slab.scalar[i]);
            const double depth = slab.depth[i] + slab.missing[i];
            const glm::vec2 exact(depth, slab.scalar[i] * (1 - depth * inverse) / (1 - slab.depth[i] * inverse));
            put({glm::vec2(slab.at[i]) / static_cast<float>(from.lattice.steps), slab.entry ? exact : on_lattice,
                 slab.entry ? on_lattice : exact},
                from.optics.empty() ? glm::vec4(0) : from.optics[slab.face[i]]);
        }
        ++count;
    }
};

std::size_t ThickTriangles::record_bytes() const
{
    return 3 * (plain_bytes + (from_.optics.empty() ? 0 : optics_bytes));
}

std::size_t ThickTriangles::make(std::span<const CellId> cells, LargeArray<std::byte>& into,
                                 std::vector<CellOffLattice>& off_lattice) const
{
    constexpr std::size_t most_a_cell = 8;
    into.resize(cells.size() * most_a_cell * record_bytes());
    return put_cells_with_slabs(from_, cells, Writer{from_, into.data()}, off_lattice);
}

} // namespace visorder
