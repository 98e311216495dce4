#pragma once

#include "scene/face_planes.h"
#include "sorting/face_pairs.h"
#include "sorting/topological_sort.h"
#include "visorder/relation.h"
#include "visorder/sorter.h"
#include "visorder/sorter_options.h"
#include "xmpvo/boundary_surface.h"
#include "xmpvo/embree_scene.h"
#include "xmpvo/ray_set.h"

#include <cstdint>
#include <span>
#include <vector>

namespace visorder::detail {

/// Extended MPVO by shooting rays (after Silva, Mitchell, Williams 1998; Max, Williams, Silva 2000, section III): MPVO
/// with relations between boundary cells. Rays go from the eye through every boundary face and past the crossings of
/// silhouettes; where one leaves the mesh and comes back, the cell it left occludes the cell it enters.
///
/// Rays are shot in single precision, so what they find is a proposal, which the exact predicates confirm or not. No
/// relation is wrong, but one that no ray found is missing. Exact on convex meshes; elsewhere approximate.
///
/// Needs adjacency, boundary and face planes. One `sort` at a time on one sorter; any number of sorters on one Scene.
class Xmpvo final : public Sorter {
public:
    /// Throws InputError for a surface scene and, naming the cell, for a face that is not planar; std::runtime_error
    /// where Embree fails.
    explicit Xmpvo(const Scene& scene, XmpvoRays rays = XmpvoRays::crossings);

    Guarantee guarantee() const override;
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override;
    std::vector<Statistic> statistics() const override;

    /// The relations between boundary cells that the last `sort` found, ascending, each once.
    std::span<const Relation> relations() const { return relations_; }

private:
    void shoot(const glm::dvec4& eye);

    Scene scene_;
    XmpvoRays rays_;
    BoundarySurface surface_;
    EmbreeScene embree_;
    FaceSigns signs_;
    std::vector<Sign> sides_;          // of the boundary faces
    std::vector<std::uint64_t> pairs_; // of boundary faces, exit << 32 | entry
    std::vector<Relation> relations_;
    TopologicalSort topological_sort_;
    SilhouetteCounts silhouette_;
    std::size_t ray_count_ = 0;
    std::size_t hit_count_ = 0;
};

} // namespace visorder::detail
