#pragma once

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

#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace visorder {

/// The cells that own the faces of a BSP tree, numbered in their order.
class BoundaryCells {
public:
    /// `faces` are ascending by cell.
    BoundaryCells(std::span<const CellFace> faces, CellId cells);

    std::size_t count() const { return first_face_.size() - 1; }
    std::uint32_t of_face(std::uint32_t face) const { return of_face_[face]; }
    /// Of a cell that is one of them.
    std::size_t of_cell(CellId cell) const
    {
        const std::uint64_t below = bits_[cell / 64] & ((std::uint64_t{1} << cell % 64) - 1);
        return before_[cell / 64] + static_cast<std::size_t>(std::popcount(below));
    }
    /// The faces of one of them, from the first to before the second.
    std::pair<std::uint32_t, std::uint32_t> faces(std::size_t boundary_cell) const
    {
        return {first_face_[boundary_cell], first_face_[boundary_cell + 1]};
    }
    std::size_t bytes() const
    {
        return bits_.capacity() * sizeof(std::uint64_t) +
               (before_.capacity() + first_face_.capacity() + of_face_.capacity()) * sizeof(std::uint32_t);
    }

private:
    std::vector<std::uint64_t> bits_;   // a cell: whether it is one
    std::vector<std::uint32_t> before_; // how many there are before each 64 cells
    std::vector<std::uint32_t> first_face_;
    std::vector<std::uint32_t> of_face_;
};

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

    void walk(const glm::dvec4& eye);
    // What the eye makes of each of the tree's faces.
    void look_at_faces(const glm::dvec4& eye);
    std::uint8_t role(std::uint32_t face, const glm::dvec4& eye) const;
    void set_boxes(std::uint32_t face, const ProjectionCharts& charts);
    // Whether exit face f covers a part of entry face g, in a pair of cells of which an order exists.
    bool obstructs(std::uint32_t f, std::uint32_t g, const glm::dvec4& eye);
    bool covers_exactly(std::uint32_t f, std::uint32_t g, const glm::dvec4& eye);
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

    LargeArray<CellId> queue_; // of cells that are ready
    ImageBoxes boxes_;
    PendingFaces pending_;

    std::size_t test_count_ = 0;
    std::size_t exact_test_count_ = 0;
    std::size_t relation_count_ = 0;

    BoundaryRelations all_relations_;
    TopologicalSort topological_sort_;
};

} // namespace visorder
