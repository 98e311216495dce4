#pragma once

#include "depth/image_extents.h"
#include "depth/obstruction.h"
#include "depth/window_lists.h"
#include "parallel/large_array.h"
#include "visorder/sorter.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace visorder::detail {

/// Newell's sort (Newell, Newell and Sancha 1972; Newell 1974) for convex cells, as Max, Williams and Silva (2000,
/// section III) describe it: cells by the z of their farthest vertex, each held against the others for whether it can
/// occlude part of them, by tests of increasing difficulty (1 to 3, 1' and 2', 4 and 5, then the definitive one). A
/// cell that occludes none left is listed; one that is found to be occluded moves to the head of the list. A cell that
/// would move a second time is in a cycle, and the cycle's cells are listed together.
///
/// Exact where the faces are planar, for solids and for surfaces, which may be any set of cells: they need not meet
/// face to face, nor meet at all. Takes every scene. Quadratic at worst; with a list for each of several windows of the
/// image
/// (`NewellOptions::windows`), cells are held only against those they share a window with.
///
/// Needs no structures, but adjacency and orientations where there are flat cells. One `sort` at a time on one sorter;
/// any number of sorters on one Scene.
class Newell final : public Sorter {
public:
    /// Throws InputError where a scene has flat cells and no adjacency.
    explicit Newell(const Scene& scene, bool windows = false);

    /// Exact where faces are planar and no cells overlap in space, which the first call has the scene find out.
    Guarantee guarantee() const override;
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override;

    /// Pairs of cells held against each other, how many each test settled (which add up to the pairs), and how often a
    /// cell moved to the head of the list, or would have a second time.
    std::vector<Statistic> statistics() const override;

private:
    enum Count : std::size_t {
        depth,
        across,
        down,
        cones,
        spheres,
        front_planes,
        back_planes,
        definitive_apart,
        definitive_obstructs,
        moves,
        second_moves,
        counts
    };

    // How far the search for cells that one cell occludes has come.
    struct Search {
        CellId cell;
        std::uint32_t extent; // of the cell's
        std::uint32_t column, row;
        std::size_t next,
            end; // in that window's list: after what passed tests 1 to 3, and where test 1 ends the search
        std::uint32_t waiting; // bits for the `block` before `next`: what passed these tests and not yet the others
    };
    static constexpr std::size_t block = 32;

    void head(CellId cell);
    bool next_obscured(Search& search, CellId& obscured);
    void first_tests(Search& search, const Extent& front, const WindowLists::List& list);
    bool obscures(CellId front, CellId back);
    void enter_extent(Search& search);
    void enter_window(Search& search);
    void list_component(CellId first, Order& order);

    Scene scene_;
    bool windows_;
    Obstruction obstruction_;
    ImageExtents extents_;
    WindowLists lists_;
    std::vector<CellId> by_farthest_;

    // Tarjan's: when a cell came to the head, and the earliest one still open that is known to be reached from it.
    LargeArray<std::uint32_t> number_, lowest_;
    std::uint32_t next_number_ = 0;
    std::vector<Search> searches_;
    std::vector<CellId> open_;
    std::size_t gone_ = 0;                // cells in the order that are still in lists
    std::vector<std::size_t> first_left_; // in each window's list, the first cell not in the order yet

    std::array<std::size_t, counts> count_{};
};

} // namespace visorder::detail
