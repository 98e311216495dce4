#pragma once

#include "parallel/large_array.h"
#include "parallel/radix_sort.h"
#include "scene/face_planes.h"
#include "sorting/topological_sort.h"
#include "visorder/sorter.h"

#include <glm/vec3.hpp>
#include <vector>

namespace visorder::detail {

/// MPVO for nonconvex meshes (Williams 1992; Max, Williams, Silva 2000, section III): the cells with front-facing
/// exterior faces, farthest first, are where depth-first traversals start that list a cell after all those it occludes
/// across its interior faces. What a far part of the boundary hides is listed before what only nearer parts hide: a
/// guess at the relations between parts of the mesh that rays leave and come back to.
///
/// Linear in cells, plus the sort of the boundary. Keeps all relations across interior faces outside of cycles, and so
/// is exact on convex meshes; elsewhere approximate. Makes no layers; reports the cycles that `mpvo` reports.
///
/// Needs adjacency, boundary and face planes. One `sort` at a time on one sorter; any number of sorters on one Scene.
class MpvoNc final : public Sorter {
public:
    /// Throws InputError for a surface scene and, naming the cell, for a face that is not planar.
    explicit MpvoNc(const Scene& scene);

    Guarantee guarantee() const override;
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override;
    std::vector<Statistic> statistics() const override;

private:
    void sort_sources(const View& view);
    template <int row, class State>
    void sort_by(LargeArray<State>& state, Order& order);
    template <int row, class State>
    void count_entry_faces(State* state);
    template <int row, class State>
    std::size_t list(State* state);
    template <int row, class State>
    void cut_cycles(State* state, const Order& order) const;

    Scene scene_;
    std::vector<CellId> owners_;     // of the boundary faces
    std::vector<glm::vec3> centres_; // of the boundary faces, in the unit coordinates of the face planes
    FaceSigns signs_;
    RadixSort<std::uint32_t> radix_sort_;
    std::vector<std::uint32_t> keys_;
    std::vector<CellId> sources_; // owners of front-facing faces, farthest first, and after them all other owners
    std::size_t source_count_ = 0;
    LargeArray<std::uint8_t> small_state_;  // of a tetrahedron
    LargeArray<std::uint16_t> large_state_; // of any other cell
    LargeArray<CellId> listed_;
    TopologicalSort topological_sort_; // used only where there are cycles
    Order order_of_cycles_;
};

} // namespace visorder::detail
