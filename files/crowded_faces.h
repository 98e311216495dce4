#pragma once

#include "files/cell_numbers.h"
#include "visorder/scene.h"

#include <string>

namespace visorder::detail {

/// One line on the faces that more than two cells share, of which it names the first one's cells; empty if there are
/// none. Derives the adjacency.
std::string crowded_faces_note(const Scene& scene, const CellNumbers& cells);

} // namespace visorder::detail
