#include "sorting/registry.h"

#include "scene/error.h"

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vector>

namespace visorder {

// Each sorter's room defines how it is made; the registry only knows the names.
std::unique_ptr<Sorter> make_centroid(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_power(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_newell(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_mpvo(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_mpvo_nc(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_xmpvo(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_xmpvo_exact(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_bsp_xmpvo(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_layers(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_layers_blocked(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_layers_compute(const Scene&, const SorterOptions&);
std::unique_ptr<Sorter> make_xmpvo_layered(const Scene&, const SorterOptions&);
#if defined(VISORDER_WITH_VTK)
std::unique_ptr<Sorter> make_vtk_cell_center(const Scene&, const SorterOptions&);
#endif

namespace {

std::unique_ptr<Sorter> make_auto(const Scene& scene, const SorterOptions& options)
{
    return make_sorter(choose_sorter(scene).name, scene, options);
}

constexpr std::array for_centroid{Structure::numbering, Structure::centroids};
constexpr std::array for_power{Structure::numbering, Structure::circumspheres};
constexpr std::array for_newell{Structure::numbering};
constexpr std::array for_mpvo{Structure::numbering, Structure::adjacency, Structure::orientations,
                              Structure::face_planes};
constexpr std::array for_boundary_and_planes{Structure::numbering, Structure::adjacency, Structure::orientations,
                                             Structure::face_planes, Structure::boundary};
constexpr std::array for_boundary_relations{
    Structure::numbering,   Structure::adjacency,         Structure::orientations,   Structure::boundary,
    Structure::face_planes, Structure::overlapping_cells, Structure::overlap_planes, Structure::relation_faces};
constexpr std::array for_layers{Structure::numbering};
constexpr std::array for_auto{Structure::numbering, Structure::adjacency, Structure::orientations, Structure::boundary,
                              Structure::traits};
#if defined(VISORDER_WITH_VTK)
constexpr std::array for_vtk{Structure::numbering};
#endif

using Make = std::unique_ptr<Sorter> (*)(const Scene&, const SorterOptions&);

constexpr std::array infos
{
    SorterInfo{"centroid", "by the distance of the cell's centre", "common practice, e.g. Shirley, Tuchman 1990",
               "never", for_centroid},
        SorterInfo{"power", "by the power of the eye with respect to the cell's circumsphere",
                   "Edelsbrunner 1989; Max, Williams, Silva 2000",
                   "never by guarantee: right on Delaunay meshes without ties, up to the rounding of the keys",
                   for_power},
        SorterInfo{"newell",
                   "by the farthest vertex, repaired by tests of whether one cell can obscure another",
                   "Newell 1974; Max, Williams, Silva 2000",
                   "where faces are planar and no cells overlap, surfaces too",
                   for_newell,
                   30'000},
        SorterInfo{"mpvo", "topological sort over the relations across interior faces", "Williams 1992",
                   "on convex meshes", for_mpvo},
        SorterInfo{"mpvo-nc", "depth-first from the front-facing boundary, farthest first, across interior faces",
                   "Williams 1992", "on convex meshes", for_boundary_and_planes},
        SorterInfo{"xmpvo", "mpvo, and relations between boundary cells by shooting rays",
                   "Silva, Mitchell, Williams 1998", "on convex meshes", for_boundary_and_planes},
        SorterInfo{"xmpvo-exact",
                   "topological sort, also over every pair of boundary faces of which one covers the other",
                   "Silva, Mitchell, Williams 1998; Max, Williams, Silva 2000",
                   "always, but for pairs of cells that overlap", for_boundary_relations},
        SorterInfo{"bsp-xmpvo", "topological sort merged with the walk of a BSP tree over the boundary faces",
                   "Comba et al. 1999; Max, Williams, Silva 2000", "always, but for pairs of cells that overlap",
                   for_boundary_relations},
        SorterInfo{"xmpvo-layered", "mpvo, and relations between boundary cells by the layers of an image of them",
                   "Krishnan, Silva, Wei 2002", "on convex meshes", for_boundary_and_planes},
        SorterInfo{"layers",
                   "layers of an image of a surface, by z-, stencil and colour buffer",
                   "Krishnan, Silva, Wei 2002",
                   "never: right at the image's sample points",
                   for_layers,
                   100'000},
        SorterInfo{"layers-blocked",
                   "the same, reading the image in blocks, and no block again that was empty",
                   "Krishnan, Silva, Wei 2002",
                   "never: right at the image's sample points",
                   for_layers,
                   100'000},
        SorterInfo{"layers-compute",
                   "the same, the image scanned by compute shaders",
                   "Krishnan, Silva, Wei 2002",
                   "never: right at the image's sample points",
                   for_layers,
                   100'000},
        SorterInfo{"auto", "the cheapest sorter that is exact for the scene, else the best there is",
                   "traits of the scene", "where the sorter it stands for is", for_auto},
#if defined(VISORDER_WITH_VTK)
        SorterInfo{"vtk-cell-center", "VTK's own sort by cell centres, as a peer to measure against",
                   "vtkCellCenterDepthSort, VTK 9.1", "never", for_vtk},
#endif
};

constexpr std::array makers
{
    Make{make_centroid}, Make{make_power}, Make{make_newell}, Make{make_mpvo}, Make{make_mpvo_nc}, Make{make_xmpvo},
        Make{make_xmpvo_exact}, Make{make_bsp_xmpvo}, Make{make_xmpvo_layered}, Make{make_layers},
        Make{make_layers_blocked}, Make{make_layers_compute}, Make{make_auto},
#if defined(VISORDER_WITH_VTK)
        Make{make_vtk_cell_center},
#endif
};
static_assert(makers.size() == infos.size());

} // namespace

std::span<const SorterInfo> sorters()
{
    return infos;
}

std::unique_ptr<Sorter> make_sorter(std::string_view name, const Scene& scene, const SorterOptions& options)
{
    for (std::size_t i = 0; i < infos.size(); ++i)
        if (name == infos[i].name)
            return makers[i](scene, options);
    std::vector<std::string_view> known;
    for (const SorterInfo& info : infos)
        known.emplace_back(info.name);
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
