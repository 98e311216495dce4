#include "projection/opengl/shader_thick_triangles.h"

#include "projection/thickness.h"

#include <array>
#include <cstring>

namespace visorder::detail {

namespace {

// What the vertex shader reads; colours of the points follow where they are interpolated.
struct ThickRecord {
    struct Point {
        double x, y;
        double depth, scalar; // see CellValues
    };
    std::array<Point, 4> points; // in the order of VisibleCell::points
    double least_width;
    std::uint32_t quad, inner_behind;
};

using PointOptics = std::array<glm::vec4, 4>;

} // namespace

std::size_t ShaderThickTriangles::record_bytes() const
{
    return sizeof(ThickRecord) + (from_.optics.empty() ? 0 : sizeof(PointOptics));
}

void ShaderThickTriangles::make(std::span<const CellId> cells, RecordSink& into, std::vector<CellApart>& apart) const
{
    const auto set_apart = [&](CellId cell) { apart.push_back({static_cast<std::uint32_t>(into.count()), cell}); };
    const auto put = [&](const VisibleCell& cell) {
        if (from_.pieces != nullptr && !single_precision_is_enough(cell, from_)) {
            set_apart(cell.cell);
            return;
        }
        const CellValues values = values_of(cell, from_.scalars, from_.screen->inverse_distance());
        ThickRecord record{};
        for (std::size_t i = 0; i < 4; ++i)
            record.points[i] = {cell.at[i].x, cell.at[i].y, values.depth[i], values.scalar[i]};
        record.least_width = cell.least_width;
        record.quad = cell.kind == SilhouetteClass::quad ? 1 : 0;
        record.inner_behind = cell.inner_behind ? 1 : 0;
        std::byte* const next = into.next();
        std::memcpy(next, &record, sizeof record);
        if (from_.optics.empty())
            return;
        PointOptics optics{};
        for (std::size_t i = 0; i < 4; ++i)
            optics[i] = from_.optics[cell.points[i]];
        std::memcpy(next + sizeof record, &optics, sizeof optics);
    };
    from_.cells->visit(cells, put, set_apart);
}

} // namespace visorder::detail
