#pragma once

#include "files/file_grid.h"

#include <functional>
#include <glm/vec3.hpp>

namespace visorder::detail {

/// Lists the cells of a grid of so many points along each axis, which are the next points from `first_point` on, x
/// fastest: hexahedra, quadrilaterals if the grid is one point thick, lines if it is so along two axes.
/// A cell is hidden if one of its points is (counted from 0 within this grid).
void add_structured_cells(FileGrid& grid, const glm::ivec3& size, std::size_t first_point,
                          const std::function<bool(std::size_t point)>& is_hidden);

} // namespace visorder::detail
