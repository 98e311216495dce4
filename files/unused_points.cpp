#include "files/unused_points.h"

namespace visorder::detail {

std::size_t drop_unused_points(Mesh& mesh)
{
    std::vector<bool> used(mesh.points.size());
    for (const PointId vertex : mesh.vertices)
        used[vertex] = true;

    std::vector<PointId> number(mesh.points.size());
    PointId kept = 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        if (used[i]) {
            number[i] = kept;
            mesh.points[kept] = mesh.points[i];
            if (!mesh.scalars.empty())
                mesh.scalars[kept] = mesh.scalars[i];
            ++kept;
        }
    const std::size_t dropped = mesh.points.size() - kept;
    mesh.points.resize(kept);
    if (!mesh.scalars.empty())
        mesh.scalars.resize(kept);
    for (PointId& vertex : mesh.vertices)
        vertex = number[vertex];
    return dropped;
}

} // namespace visorder::detail
