#include "scenes/unused_points.h"

#include <limits>
#include <vector>

namespace visorder::scenes {

void drop_unused_points(Mesh& mesh)
{
    constexpr PointId unused = std::numeric_limits<PointId>::max();
    std::vector<PointId> number(mesh.points.size(), unused);
    for (const PointId vertex : mesh.vertices)
        number[vertex] = 0;
    PointId used = 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        if (number[i] != unused) {
            mesh.points[used] = mesh.points[i];
            number[i] = used++;
        }
    mesh.points.resize(used);
    for (PointId& vertex : mesh.vertices)
        vertex = number[vertex];
}

} // namespace visorder::scenes
