#include "files/structured_cells.h"

#include <algorithm>
#include <array>

namespace visorder::detail {

void add_structured_cells(FileGrid& grid, const glm::ivec3& size, std::size_t first_point,
                          const std::function<bool(std::size_t point)>& is_hidden)
{
    const std::array<std::size_t, 3> steps{1, static_cast<std::size_t>(size.x),
                                           static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
    std::vector<std::size_t> along; // the steps along the axes that the grid extends in
    for (int axis = 0; axis < 3; ++axis)
        if (size[axis] > 1)
            along.push_back(steps[static_cast<std::size_t>(axis)]);

    std::vector<std::size_t> offsets{0}; // of a cell's points from its first, in VTK's order
    if (!along.empty())
        offsets.push_back(along[0]);
    if (along.size() > 1) {
        offsets.push_back(along[0] + along[1]);
        offsets.push_back(along[1]);
    }
    if (along.size() > 2)
        for (std::size_t i = 0; i < 4; ++i)
            offsets.push_back(offsets[i] + along[2]);
    const ListedShape shape = along.size() > 2   ? ListedShape::hexahedron
                              : along.size() > 1 ? ListedShape::polygon
                                                 : ListedShape::lower;

    const glm::ivec3 cells = glm::ivec3(std::max(size.x - 1, 1), std::max(size.y - 1, 1), std::max(size.z - 1, 1));
    std::vector<std::int64_t> corners(offsets.size());
    for (int k = 0; k < cells.z; ++k)
        for (int j = 0; j < cells.y; ++j)
            for (int i = 0; i < cells.x; ++i) {
                const std::size_t first = static_cast<std::size_t>(i) + static_cast<std::size_t>(j) * steps[1] +
                                          static_cast<std::size_t>(k) * steps[2];
                bool hidden = false;
                for (std::size_t c = 0; c < offsets.size(); ++c) {
                    hidden = hidden || is_hidden(first + offsets[c]);
                    corners[c] = static_cast<std::int64_t>(first_point + first + offsets[c]);
                }
                grid.add({shape, false, hidden}, corners);
            }
}

} // namespace visorder::detail
