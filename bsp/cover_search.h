#pragma once

#include "bsp/bsp_tree.h"
#include "bsp/corner_heights.h"
#include "bsp/face_corners.h"
#include "bsp/face_images.h"
#include "bsp/image_boxes.h"
#include "bsp/pending_faces.h"
#include "bsp/touching_faces.h"
#include "scene/adjacency.h"
#include "visorder/scene.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// Finds, from one eye after the other, which entry faces a boundary exit face covers: exactly, behind quick tests. Of
/// those that touch it (see TouchingFaces::holds), all, in one sweep along the boundary; of the others, when asked for,
/// one that is pending, and by then few are that may be covered.
///
/// Any number of threads may `find` side by side, each with a Workspace of its own; the rest is done alone.
class CoverSearch {
public:
    /// Of a face at an eye: that it is an exit face, an entry face, or, on a surface, both.
    static constexpr std::uint8_t exit_role = 1;
    static constexpr std::uint8_t entry_role = 2;

    static constexpr std::uint32_t none = 0xffffffffu;

    /// How many pairs of faces were tested for a common part of their images, and how many of them exactly.
    struct Tests {
        std::size_t all = 0;
        std::size_t exact = 0;
    };

    /// Of the faces of `tree`. Throws InputError, naming the cell, where a face is not planar.
    CoverSearch(const Scene& scene, const BspTree& tree);

    const FaceCorners& corners() const { return corners_; }

    /// From this eye on: the faces' roles there, 0 of a face that has none, and their ranks. On all threads. `roles`
    /// must live until the next call.
    void look_from(const glm::dvec4& eye, std::span<const std::uint8_t> roles, std::span<const Ranks> ranks);

    /// All entry faces are pending again.
    void reset_pending();
    /// The cell of an entry face has been listed.
    void remove(std::uint32_t face) { pending_.remove(face); }

    class Workspace;
    /// Of each of some exit faces, a pending one that it covers and does not touch, or none. The same whatever they
    /// stand beside.
    void find(std::span<const std::uint32_t> faces, std::span<std::uint32_t> covered, Workspace& workspace);

    /// Two faces that touch, of which the first covers a part of the second.
    struct Cover {
        std::uint32_t front, back;
    };
    /// All of them, ascending by the first, in as many parts as `touching` is made to hold. On all threads.
    void find_touching(std::vector<std::vector<Cover>>& touching, Tests& tests) const;

    std::size_t bytes() const;

private:
    // Whether the cells of two faces have an order, and do not share a face, which would carry the relation.
    bool relate(std::uint32_t f, std::uint32_t g) const;
    bool covers(std::uint32_t f, std::uint32_t g, bool nearer, Tests& tests) const;
    bool covers(std::uint32_t f, const TouchingFaces::Touching& g, Tests& tests) const;
    bool covers_exactly(std::uint32_t f, std::uint32_t g, Shared shared, Tests& tests) const;
    void set_boxes(std::uint32_t face, const ProjectionCharts& charts, Ranks ranks);

    Scene scene_;
    std::span<const CellFace> faces_;
    FaceCorners corners_;
    CornerHeights heights_;
    TouchingFaces touching_;

    glm::dvec4 eye_{};
    std::span<const std::uint8_t> roles_;
    FaceImages images_;
    bool has_images_ = false; // from this eye
    ImageBoxes boxes_;
    PendingFaces pending_;
};

/// What one thread searches with, kept from frame to frame.
class CoverSearch::Workspace {
public:
    Tests tests; ///< since it was last set

    std::size_t bytes() const { return found_.bytes() + end_.capacity() * sizeof(std::uint32_t); }

private:
    friend class CoverSearch;
    PendingFaces::Found found_;      // for one face after the other
    std::vector<std::uint32_t> end_; // of each face's
};

} // namespace visorder::detail
