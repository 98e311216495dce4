#include "visorder/sorters.h"

#include "bsp/bsp_xmpvo.h"
#include "depth/centroid.h"
#include "depth/newell.h"
#include "depth/power.h"
#include "layering/layers_sorter.h"
#include "layering/xmpvo_layered.h"
#include "mpvo/mpvo.h"
#include "mpvo/mpvo_nc.h"
#include "visorder/error.h"
#include "visorder/sorter_options.h"
#include "xmpvo/xmpvo.h"
#include "xmpvo/xmpvo_exact.h"
#if defined(VISORDER_WITH_VTK)
#include "vtk/vtk_cell_center.h"
#endif

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace visorder {

using namespace detail;

namespace {

constexpr std::array numbering{Structure::numbering};
constexpr std::array centroids{Structure::numbering, Structure::centroids};
constexpr std::array circumspheres{Structure::numbering, Structure::circumspheres};
constexpr std::array interior_faces{Structure::numbering, Structure::adjacency, Structure::orientations,
                                    Structure::face_planes};
constexpr std::array interior_and_boundary_faces{Structure::numbering, Structure::adjacency, Structure::orientations,
                                                 Structure::face_planes, Structure::boundary};
constexpr std::array all_relations{Structure::numbering,      Structure::adjacency,     Structure::orientations,
                                   Structure::boundary,       Structure::face_planes,   Structure::overlapping_cells,
                                   Structure::overlap_planes, Structure::relation_faces};
constexpr std::array traits{Structure::numbering, Structure::adjacency, Structure::orientations, Structure::boundary,
                            Structure::traits};

using Made = std::unique_ptr<Sorter>;

template <class T>
Made make(const Scene& scene, const SorterOptions&)
{
    return std::make_unique<T>(scene);
}

Made make_newell(const Scene& scene, const SorterOptions& options)
{
    return std::make_unique<Newell>(scene, options.newell.windows);
}

Made make_xmpvo(const Scene& scene, const SorterOptions& options)
{
    return std::make_unique<Xmpvo>(scene, options.xmpvo.rays);
}

Made make_bsp_xmpvo(const Scene& scene, const SorterOptions& options)
{
    return std::make_unique<BspXmpvo>(scene, options.bsp_xmpvo.seed);
}

Made make_xmpvo_layered(const Scene& scene, const SorterOptions& options)
{
    return std::make_unique<XmpvoLayered>(scene, options.layers.gl, options.layers.image_size);
}

template <LayerVariant variant>
Made make_layers(const Scene& scene, const SorterOptions& options)
{
    const LayerOptions& layers = options.layers;
    return std::make_unique<LayersSorter>(scene, variant, layers.gl, layers.image_size, layers.block);
}

Made make_auto(const Scene& scene, const SorterOptions& options)
{
    return make_sorter(choose_sorter(scene).name, scene, options);
}

// Beyond these numbers of cells, sorters that take quadratic time or an image per layer are too slow.
constexpr CellId newell_cells = 30'000;
constexpr CellId layers_cells = 100'000;

// Every sorter, one row each.
constexpr std::array rows
{
    SorterInfo{"centroid",
               "by the distance of the cell's centre",
               "common practice, e.g. Shirley, Tuchman 1990",
               "never",
               centroids,
               make<Centroid>},
        SorterInfo{"power",
                   "by the power of the eye with respect to the cell's circumsphere",
                   "Edelsbrunner 1989; Max, Williams, Silva 2000",
                   "never by guarantee: right on Delaunay meshes without ties, up to the rounding of the keys",
                   circumspheres,
                   make<Power>},
        SorterInfo{"newell",
                   "by the farthest vertex, repaired by tests of whether one cell can occlude another",
                   "Newell 1974; Max, Williams, Silva 2000",
                   "where faces are planar and no cells overlap, surfaces too",
                   numbering,
                   make_newell,
                   newell_cells},
        SorterInfo{"mpvo",          "topological sort over the relations across interior faces",
                   "Williams 1992", "on convex meshes",
                   interior_faces,  make<Mpvo>},
        SorterInfo{"mpvo-nc",
                   "depth-first from the front-facing boundary, farthest first, across interior faces",
                   "Williams 1992",
                   "on convex meshes",
                   interior_and_boundary_faces,
                   make<MpvoNc>},
        SorterInfo{"xmpvo",
                   "mpvo, and relations between boundary cells by shooting rays",
                   "Silva, Mitchell, Williams 1998",
                   "on convex meshes",
                   interior_and_boundary_faces,
                   make_xmpvo},
        SorterInfo{"xmpvo-exact",
                   "topological sort, also over every pair of boundary faces of which one occludes the other",
                   "Silva, Mitchell, Williams 1998; Max, Williams, Silva 2000",
                   "always, but for pairs of cells that overlap",
                   all_relations,
                   make<XmpvoExact>},
        SorterInfo{"bsp-xmpvo",
                   "topological sort merged with the traversal of a BSP tree over the boundary faces",
                   "Comba et al. 1999; Max, Williams, Silva 2000",
                   "always, but for pairs of cells that overlap",
                   all_relations,
                   make_bsp_xmpvo},
        SorterInfo{"xmpvo-layered",
                   "mpvo, and relations between boundary cells by the layers of an image of them",
                   "Krishnan, Silva, Wei 2002",
                   "on convex meshes",
                   interior_and_boundary_faces,
                   make_xmpvo_layered},
        SorterInfo{"layers",
                   "layers of an image of a surface, by z-, stencil and colour buffer",
                   "Krishnan, Silva, Wei 2002",
                   "never: right at the image's sample points",
                   numbering,
                   make_layers<LayerVariant::naive>,
                   layers_cells},
        SorterInfo{"layers-blocked",
                   "the same, reading the image in blocks, and no block again that was empty",
                   "Krishnan, Silva, Wei 2002",
                   "never: right at the image's sample points",
                   numbering,
                   make_layers<LayerVariant::blocked>,
                   layers_cells},
        SorterInfo{"layers-compute",
                   "the same, the image scanned by compute shaders",
                   "Krishnan, Silva, Wei 2002",
                   "never: right at the image's sample points",
                   numbering,
                   make_layers<LayerVariant::compute>,
                   layers_cells},
        SorterInfo{"auto",
                   "the cheapest sorter that is exact for the scene, else the best there is",
                   "traits of the scene",
                   "where the sorter it stands for is",
                   traits,
                   make_auto},
#if defined(VISORDER_WITH_VTK)
        SorterInfo{"vtk-cell-center",
                   "VTK's own sort by cell centres, as a peer to measure against",
                   "vtkCellCenterDepthSort, VTK 9.1",
                   "never",
                   numbering,
                   make<VtkCellCenter>},
#endif
};

} // namespace

std::span<const SorterInfo> sorters()
{
    return rows;
}

Made make_sorter(std::string_view name, const Scene& scene, const SorterOptions& options)
{
    for (const SorterInfo& row : rows)
        if (name == row.name)
            return row.make(scene, options);
    std::vector<std::string_view> known;
    for (const SorterInfo& row : rows)
        known.emplace_back(row.name);
    throw InputError(fmt::format("no sorter \"{}\"; there are: {}", name, fmt::join(known, ", ")));
}

AutoChoice choose_sorter(const Scene& scene)
{
    if (scene.is_surface())
        return {"bsp-xmpvo", "a surface: each triangle may cover each other one"};
    const Traits& traits = scene.traits();
    if (!traits.planar_faces)
        return {"centroid", "faces that are not planar: no sorter here is exact for them; subdivide into tetrahedra"};
    if (traits.convex)
        return {"mpvo", "the mesh is convex: relations across interior faces are all there are"};
    if (const std::size_t pairs = scene.overlapping_cells().size(); pairs > 0)
        return {"bsp-xmpvo", fmt::format("cells overlap: {}", describe(Guarantee::exact_but_for_overlaps, pairs))};
    return {"bsp-xmpvo", "the mesh is not convex: rays may leave it and come back"};
}

Order visibility_order(const Mesh& mesh, const View& view)
{
    const Scene scene(mesh);
    Order order;
    make_sorter("auto", scene)->sort(view, order);
    return order;
}

} // namespace visorder
