#include "projection/triangle_sources.h"

#include "projection/optical_passes.h"

#include <algorithm>

namespace visorder::detail {

bool single_precision_is_enough(const VisibleCell& cell, const TriangleSources& from)
{
    double lowest = from.scalars[cell.points[0]];
    double highest = lowest;
    for (const PointId point : cell.points) {
        const double scalar = from.scalars[point];
        lowest = std::min(lowest, scalar);
        highest = std::max(highest, scalar);
    }
    const double inverse = from.screen->inverse_distance();
    const double longest = (cell.farthest - cell.nearest) * from.screen->longest_ray() /
                           ((1 - cell.nearest * inverse) * (1 - cell.farthest * inverse));
    return looked_up_in_single_precision(*from.pieces, lowest, highest, longest);
}

} // namespace visorder::detail
