#pragma once

#include "geometry/exact_predicates.h"
#include "geometry/face_overlap.h"
#include "parallel/large_array.h"
#include "scene/face_loop.h"
#include "visorder/scene.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>

namespace visorder::detail {

/// What settles whether a cell can occlude part of another.
enum class Settled {
    by_front_plane, ///< it cannot: the other lies in front of the plane of one of its entry faces (test 4)
    by_back_plane,  ///< it cannot: it lies behind the plane of one of the other's exit faces (test 5)
    apart,    ///< it cannot: the definitive test found no ray through both, or only rays that meet the other first
    obstructs ///< it does, by the definitive test
};

/// Whether one cell can occlude part of another from an eye: the tests of Newell, Newell and Sancha (1972) on the
/// planes of the two cells' faces, then a definitive one, as Max, Williams and Silva (2000, section III) put them. All
/// decisions are exact, and about each pair of cells alone: cells need no neighbours, and may touch in any way.
///
/// The definitive test: a covers part of b if an exit face of a covers part of an entry face of b, nearer or
/// coincident. Two convex cells that do not overlap come in one order along all rays through both, so that a pair of
/// such faces in the other order tells that they do overlap in space; then there is no order of them, and neither
/// occludes the other. Two triangles of a surface that cross, or lie in one plane, occlude each other no more.
///
/// A flat cell occludes nothing itself; its relations to the solid cells on both sides of it (see Adjacency) only place
/// it between them. So the adjacency is derived only where a scene has flat cells.
///
/// `look_from` is one call at a time; between two of them any number of threads may ask.
class Obstruction {
public:
    /// Throws InputError where a scene has flat cells and no adjacency.
    explicit Obstruction(const Scene& scene);

    /// Whether the vertices of every face lie in one plane. Where they do not, the tests are near the truth at best.
    bool planar_faces() const { return planar_; }

    /// Finds out which faces the eye sees, in parallel. `eye` is finite and not all zero.
    void look_from(const glm::dvec4& eye);

    /// Whether the cell can occlude others at all (a solid with an exit face), or be occluded (one with an entry face).
    bool can_obstruct(CellId cell) const
    {
        return is_flat(cell) || seen_[cell].exit != 0 || (scene_.is_surface() && seen_[cell].entry != 0);
    }
    bool can_be_obstructed(CellId cell) const
    {
        return is_flat(cell) || seen_[cell].entry != 0 || (scene_.is_surface() && seen_[cell].exit != 0);
    }

    /// Both cells can do what is asked: `can_obstruct(front)`, `can_be_obstructed(back)`.
    Settled test(CellId front, CellId back) const;

    std::size_t bytes() const
    {
        return triples_.capacity() * sizeof(FaceTriple) + seen_.capacity() * sizeof(Seen) + flat_.capacity();
    }

private:
    // Faces as bits, those in which the eye lies left out of both.
    struct Seen {
        std::uint8_t entry, exit;
    };

    bool is_flat(CellId cell) const { return !flat_.empty() && flat_[cell] != 0; }
    const FaceTriple& triple(CellId cell, int face) const
    {
        return triples_[std::size_t{cell} * static_cast<std::size_t>(row_length_) + static_cast<std::size_t>(face)];
    }
    SeenFace seen_face_of(CellId cell, int face) const;
    Sign eye_side_of_triangle(CellId cell) const { return seen_[cell].entry != 0 ? Sign::positive : Sign::negative; }
    bool has_on_side(CellId cell, int face, Sign side, CellId other) const;
    Settled definitive(CellId front, CellId back) const;
    bool obstructs_beside_flat(CellId front, CellId back) const;

    Scene scene_;
    int row_length_;
    bool planar_ = true;
    LargeArray<FaceTriple> triples_; // of each face, counterclockwise from outside; a vertex thrice if there is none
    LargeArray<std::uint8_t> flat_;  // 1 for a flat cell with faces; empty if there are none
    LargeArray<Seen> seen_;
    glm::dvec4 eye_{};
};

} // namespace visorder::detail
