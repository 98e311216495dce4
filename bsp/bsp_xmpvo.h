#pragma once

#include "bsp/boundary_cells.h"
#include "bsp/bsp_tree.h"
#include "bsp/corner_heights.h"
#include "bsp/face_corners.h"
#include "bsp/face_images.h"
#include "bsp/pending_faces.h"
#include "scene/face_planes.h"
#include "scene/large_array.h"
#include "sorting/boundary_relations.h"
#include "sorting/projection_charts.h"
#include "sorting/sorter.h"
#include "sorting/topological_sort.h"

#include <cstdint>
#include <span>
#include <vector>

namespace visorder {

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

    Guarantee guarantee() const override { return Guarantee::exact; }
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override;
    /// Of the tree: "nodes", "splits" and "depth"; of the last sort: "pair tests", of an exit face and a pending one,
    /// how many of them were "exact tests", and the "relations" they found.
    std::vector<Statistic> statistics() const override;

private:
    template <int row, class State>
    friend class BspMerge;

    // Of a face at an eye.
    static constexpr std::uint8_t exit_role = 1;
    static constexpr std::uint8_t entry_role = 2;

    static constexpr std::uint16_t slab_count = 64; // of the scene's depth
    static constexpr std::uint16_t no_slab = slab_count;
    static constexpr std::uint32_t no_cell = 0xffffffffu;

    void walk(const glm::dvec4& eye);
    // What the eye makes of each of the tree's faces.
    void look_at_faces(const glm::dvec4& eye);
    // To before any cell is listed.
    void reset_pending();
    std::uint8_t role(std::uint32_t face, const glm::dvec4& eye) const;
    void set_boxes(std::uint32_t face, const ProjectionCharts& charts);
    // How many pairs of faces were tested.
    struct Tests {
        std::size_t all = 0;
        std::size_t exact = 0;
    };
    // Whether exit face f covers a part of entry face g, in a pair of cells of which an order exists.
    bool obstructs(std::uint32_t f, std::uint32_t g, const glm::dvec4& eye, Tests& tests) const;
    bool covers_exactly(std::uint32_t f, std::uint32_t g, const glm::dvec4& eye, Tests& tests) const;
    template <int row, class State>
    bool sort_by(LargeArray<State>& state, const glm::dvec4& eye, Order& order);
    // Where relations run in circles, which the merge cannot tell apart: over all relations.
    void sort_with_cycles(const glm::dvec4& eye, Order& order);

    const Scene& scene_;
    BspTree tree_;
    BoundaryCells boundary_cells_;
    FaceCorners corners_;
    CornerHeights heights_;
    FaceSigns signs_;
    LargeArray<std::uint8_t> small_state_;
    LargeArray<std::uint16_t> large_state_;

    // A face of the tree each.
    std::vector<std::uint8_t> roles_; // an exit face, an entry face, or both
    Ranks ranks_;                     // in the walk
    FaceImages images_;
    bool has_images_ = false; // from this eye

    // A boundary cell each.
    std::vector<std::uint8_t> is_listed_;
    std::vector<std::uint32_t> waiting_head_; // of the cells that wait for it
    std::vector<std::uint32_t> next_;         // in the list of those that wait for one cell or are in one slab
    std::vector<std::uint16_t> slabs_;        // of depth, of a cell with exit faces

    std::vector<std::uint32_t> deferred_; // of a slab: the ready cells that are still to look for what they cover

    // Of one step.
    std::vector<std::uint32_t> looking_;        // the boundary cells that look for what they cover,
    std::vector<std::uint32_t> covered_;        // and a face that each found
    std::vector<std::uint32_t> listed_in_step_; // boundary cells

    LargeArray<CellId> queue_; // of cells that are ready
    ImageBoxes boxes_;
    PendingFaces pending_;

    Tests tests_;
    std::size_t relation_count_ = 0;

    BoundaryRelations all_relations_;
    TopologicalSort topological_sort_;
};

} // namespace visorder
