#pragma once

#include "visorder/sorter.h"
#include "visorder/sorter_options.h"

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace visorder {

/// What there is to know of a sorter before making one.
struct SorterInfo {
    const char* name;
    const char* summary;                                                 ///< one line
    const char* source;                                                  ///< the paper or program it comes from
    const char* exact_when;                                              ///< on which scenes it is exact
    std::span<const Structure> structures;                               ///< what it asks its Scene to derive
    std::unique_ptr<Sorter> (*make)(const Scene&, const SorterOptions&); ///< as make_sorter does by its name
    CellId up_to = std::numeric_limits<CellId>::max(); ///< cells beyond which it is too slow to run unless asked for
};

/// Every sorter of this build, in the order tables show them.
std::span<const SorterInfo> sorters();

/// Makes a sorter for a scene, which must outlive it. Throws InputError for an unknown name (the known ones are listed)
/// and for a scene that the sorter cannot take (the reason is given), and GraphicsError (graphics/graphics_error.h)
/// where a sorter needs OpenGL and there is none.
std::unique_ptr<Sorter> make_sorter(std::string_view name, const Scene& scene, const SorterOptions& options = {});

/// The sorter that `auto` stands for on a scene, and why.
struct AutoChoice {
    const char* name;
    std::string reason;
};
AutoChoice choose_sorter(const Scene& scene);

/// Orders a mesh once, by `auto`. Prepare a Scene and a Sorter instead when ordering from more than one eye.
Order visibility_order(const Mesh& mesh, const View& view);

} // namespace visorder
