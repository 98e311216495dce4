#pragma once

#include "scene/face_planes.h"
#include "sorting/boundary_relations.h"
#include "sorting/topological_sort.h"
#include "visorder/sorter.h"

namespace visorder::detail {

/// XMPVO (Silva, Mitchell, Williams 1998) by exact tests of pairs instead of rays: a topological sort over the
/// relations across interior faces and those of every exit boundary face to every entry boundary face that it covers in
/// part. Exact on every acyclic set of cells with planar faces that meet face to face or touch in any other way, for
/// every eye; on surfaces as well. Cells that overlap in space have no order, and the relations between them are left
/// out.
///
/// One `sort` at a time on one sorter; any number of sorters on one Scene.
class XmpvoExact final : public Sorter {
public:
    /// Throws InputError, naming the cell, where a face is not planar.
    explicit XmpvoExact(const Scene& scene);

    Guarantee guarantee() const override { return exact_up_to_overlaps(scene_); }
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override;
    /// "candidate pairs" put to the exact test, and the "relations" found.
    std::vector<Statistic> statistics() const override;

private:
    Scene scene_;
    FaceSigns signs_;
    BoundaryRelations boundary_;
    std::vector<Relation> tentative_;
    TopologicalSort topological_sort_;
};

} // namespace visorder::detail
