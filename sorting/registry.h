#pragma once

#include "sorting/sorter.h"

#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace visorder {

/// The rays that `xmpvo` shoots.
enum class XmpvoRays {
    faces,    ///< through every boundary face: its centre and its vertices, pulled in
    crossings ///< those, and through the crossings of projected silhouette edges
};

/// Options of the sorters; each reads those that concern it.
struct SorterOptions {
    XmpvoRays xmpvo_rays = XmpvoRays::crossings;
    bool newell_windows = false; ///< `newell` keeps a list of cells for each of several windows of the image plane
    std::uint64_t bsp_seed = 1;  ///< of the samples from which `bsp-xmpvo` takes its splitting planes

    // Of those that look at an image: layers, layers-blocked, layers-compute, xmpvo-layered.
    glm::ivec2 layer_size{0}; ///< pixels of the image; 0: those of the view
    int layer_block = 64;     ///< of `layers-blocked`: pixels of a block's side
    std::string gl = "auto";  ///< where OpenGL comes from: auto, egl or osmesa
};

/// What there is to know of a sorter before making one.
struct SorterInfo {
    const char* name;
    const char* summary;                               ///< one line
    const char* source;                                ///< the paper or program it comes from
    const char* exact_when;                            ///< on which scenes it is exact
    std::span<const Structure> structures;             ///< what it asks its Scene to derive
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
