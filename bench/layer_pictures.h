#pragma once

#include "layering/layers_sorter.h"
#include "visorder/mesh.h"

#include <cstdint>
#include <filesystem>

namespace visorder::bench {

using namespace detail;

/// Paints the layers of a surface as one view sees them, in colour, what is without proof in grey (after Fig. 3 of
/// Krishnan, Silva, Wei 2002): layers.png from that view, turned.png from another one, and layer-001.png, ... each
/// alone. Returns how many there are. `sorter` is one of a Scene made of `mesh`. Makes the folder; throws InputError or
/// std::filesystem::filesystem_error where nothing can be written.
std::uint32_t write_layer_pictures(const Mesh& mesh, LayersSorter& sorter, const View& view, const View& turned,
                                   const std::filesystem::path& folder);

} // namespace visorder::bench
