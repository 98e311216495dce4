#pragma once

#include "bsp/boundary_cells.h"
#include "bsp/bsp_tree.h"
#include "bsp/cover_search.h"
#include "bsp/image_boxes.h"
#include "parallel/large_array.h"
#include "scene/face_planes.h"
#include "sorting/boundary_relations.h"
#include "sorting/topological_sort.h"
#include "visorder/sorter.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// BSP-XMPVO (Comba, Klosowski, Max, Mitchell, Silva, Williams 1999; Max, Williams, Silva 2000, section III): a
/// topological sort of the cells over the relations across interior faces, merged with the order in which the walk of a
/// BSP tree over the boundary faces passes them from back to front. An entry face is pending until its cell is listed.
/// A cell is ready when all cells behind its interior exit faces are listed; before it is listed, its boundary exit
/// faces are tested against the pending faces that the walk came to before it left them, and it waits for the cell of
/// one that they cover. Exact on every acyclic set of cells with planar faces, for every eye, and on surfaces, whose
/// triangles are what is ordered: fragments of them that the tree makes are not.
///
/// The tree is built once a scene. One `sort` at a time on one sorter; any number of sorters on one Scene.
class BspXmpvo final : public Sorter {
public:
    /// Throws InputError, naming the cell, where a face is not planar.
    BspXmpvo(const Scene& scene, std::uint64_t seed);

    Guarantee guarantee() const override { return exact_up_to_overlaps(scene_); }
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override;
    /// Of the tree: "nodes", "splits" and "depth"; of the last sort: "pair tests", of an exit face and an entry face,
    /// how many of them were "exact tests", and the "relations" that were found by tests or known before.
    std::vector<Statistic> statistics() const override;

private:
    template <int row, class State>
    friend class BspMerge;

    static constexpr std::uint8_t exit_role = CoverSearch::exit_role;
    static constexpr std::uint8_t entry_role = CoverSearch::entry_role;

    static constexpr std::uint8_t slab_count = 64; // of the scene's depth
    static constexpr std::uint8_t no_slab = slab_count;
    static constexpr std::uint32_t no_cell = 0xffffffffu;

    void walk(const glm::dvec4& eye);
    // What the eye makes of each of the tree's faces.
    void look_at_faces(const glm::dvec4& eye);
    // To before any cell is listed.
    void reset_pending();
    void relate_touching();
    std::uint8_t role_of(std::uint32_t face, const glm::dvec4& eye) const;
    template <int row, class State>
    bool sort_by(LargeArray<State>& state, Order& order);
    // Where relations run in circles, which the merge cannot tell apart: over all relations.
    void sort_with_cycles(const glm::dvec4& eye, Order& order);

    Scene scene_;
    BspTree tree_;
    BoundaryCells boundary_cells_;
    CoverSearch cover_search_;
    FaceSigns signs_;
    LargeArray<std::uint8_t> small_state_;
    LargeArray<std::uint16_t> large_state_;

    // A face of the tree each.
    std::vector<std::uint8_t> roles_; // an exit face, an entry face, or both
    std::vector<Ranks> ranks_;        // in the walk

    struct BoundaryCell {
        CellId cell;
        std::uint32_t first_face;
        std::uint8_t exits, entries; // bits of its faces, from the first on
        bool is_listed;
        std::uint32_t waiting_head;           // of the cells that wait for it
        std::uint32_t next;                   // in the list of those that wait for the same cell
        std::uint32_t front_begin, front_end; // in fronts_: those that cover it where they touch
    };
    std::vector<BoundaryCell> cells_;
    std::vector<std::uint8_t> slabs_; // of depth, each one's that has exit faces
    std::vector<std::uint32_t> fronts_;
    // Of a boundary cell: how many faces it covers that touch its own and are not listed, and this while the cells
    // behind its interior exit faces are not all listed.
    static constexpr std::uint32_t not_ready = 0x80000000;
    std::vector<std::uint32_t> blocked_;

    // Of a slab: the ready cells that are still to look for what they cover.
    std::array<std::vector<std::uint32_t>, slab_count> deferred_;

    // Of one step.
    std::vector<std::uint32_t> looking_;        // the boundary cells that look for what they cover,
    std::vector<std::uint32_t> exits_;          // their exit faces in sequence,
    std::vector<std::uint32_t> covered_;        // and a face that each of these covers
    std::vector<std::uint32_t> listed_in_step_; // boundary cells

    LargeArray<CellId> queue_; // of cells that are ready

    std::vector<std::vector<CoverSearch::Cover>> touching_covers_;
    CoverSearch::Tests touching_tests_;
    std::vector<CoverSearch::Workspace> workspaces_; // of the threads
    std::size_t relation_count_ = 0;

    std::vector<Relation> tentative_;
    BoundaryRelations all_relations_;
    TopologicalSort topological_sort_;
};

} // namespace visorder::detail
