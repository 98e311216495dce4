#include "apps/missing_scalars.h"

#include "scene/scalar_interval.h"
#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace visorder::apps {

using namespace detail;

namespace {

bool is_missing(float scalar)
{
    return !std::isfinite(scalar);
}

/// Drops the cells with a missing scalar; returns how many.
std::size_t drop_cells(SourcedMesh& sourced)
{
    const Mesh& mesh = sourced.mesh;
    Mesh kept;
    std::vector<std::uint64_t> file_cells;
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        const auto vertices = mesh.cell(cell);
        if (std::any_of(vertices.begin(), vertices.end(), [&](PointId v) { return is_missing(mesh.scalars[v]); }))
            continue;
        kept.add(mesh.shapes[cell], vertices);
        file_cells.push_back(sourced.cells.file_cells()[cell]);
    }
    const std::size_t dropped = mesh.cell_count() - kept.cell_count();
    if (kept.cell_count() == 0)
        throw InputError(
            fmt::format("{}: nothing to draw: each of the {} cells has a scalar that is missing; see --nan",
                        sourced.name, dropped));
    kept.points = std::move(sourced.mesh.points);
    kept.scalars = std::move(sourced.mesh.scalars);
    sourced.mesh = std::move(kept);
    sourced.cells = CellNumbers(std::move(file_cells), sourced.cells.blocks());
    return dropped;
}

} // namespace

std::size_t settle_missing_scalars(SourcedMesh& sourced, const std::string& way)
{
    const std::vector<float>& scalars = sourced.mesh.scalars;
    const auto count = std::count_if(scalars.begin(), scalars.end(), is_missing);
    if (count == 0)
        return 0;
    if (way == "refuse")
        throw InputError(fmt::format("{}: {} scalars are missing; see --nan", sourced.name, count));
    const std::size_t dropped = way == "drop" ? drop_cells(sourced) : 0;
    const auto interval = scalar_interval(sourced.mesh).value_or(ScalarInterval{0, 0});
    std::replace_if(sourced.mesh.scalars.begin(), sourced.mesh.scalars.end(), is_missing,
                    static_cast<float>(interval.lowest));
    return dropped;
}

} // namespace visorder::apps
