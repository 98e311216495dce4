#pragma once

#include "scene/face_planes.h"
#include "sorting/topological_sort.h"
#include "visorder/sorter.h"

namespace visorder::detail {

/// Meshed polyhedra visibility ordering (Williams 1992; Max, Williams, Silva 2000, section III): a topological sort of
/// the cells over the relations across their interior faces. Linear in cells. Exact on convex meshes; elsewhere
/// approximate, because rays that leave the mesh and come back are not seen.
///
/// Needs adjacency and face planes. One `sort` at a time on one sorter; any number of sorters on one Scene.
class Mpvo final : public Sorter {
public:
    /// Throws InputError for a surface scene and, naming the cell, for a face that is not planar.
    explicit Mpvo(const Scene& scene);

    Guarantee guarantee() const override;
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override { return signs_.bytes() + topological_sort_.bytes(); }

private:
    Scene scene_;
    FaceSigns signs_;
    TopologicalSort topological_sort_;
};

} // namespace visorder::detail
