#pragma once

#include "bsp/corner_heights.h"
#include "bsp/face_corners.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace visorder::detail {

/// The pairs of boundary faces with a corner in common of which one may cover the other. On a boundary that is jagged
/// at the size of a cell, most of what a face covers touches it, and most of what touches it it covers from no eye:
/// both are known before any eye is.
///
/// Immutable; any number of threads may read it.
class TouchingFaces {
public:
    /// What is known of a face where it may cover another one.
    enum class Known : std::uint8_t {
        nothing,
        nearer, ///< it is, on the rays that meet both: only their images have to be compared
        covers  ///< it does, where it is an exit face and the other an entry face
    };
    /// A face that may be covered. The two have corner `at` of the covering one and `other_at` of this one in common.
    struct Touching {
        std::uint32_t face;
        std::uint8_t at : 2, other_at : 2;
        bool at_one_corner : 1; ///< and no other
        Known known : 2;
        /// Bits of the corners next to the common one, those of the covering face before those of this one, of either
        /// first the one after it: those that are for sure outside the other face's plane, where the covering face is
        /// nearer, and those that are for sure inside.
        std::uint8_t outside : 4, inside : 4;
    };

    /// `may_cover(f, g)`: whether face f, where it is an exit face, may cover a part of g, where that is an entry face,
    /// from some eye; `yes` if it is nearer for sure. It is asked on all threads. What is given must live as long as
    /// this.
    TouchingFaces(const FaceCorners& corners, const CornerHeights& heights,
                  const std::function<Sure(std::uint32_t f, std::uint32_t g)>& may_cover);

    /// Whether a pair was asked about, for it has a corner in common around which there are not too many faces: of
    /// those there would be too many pairs.
    bool holds(std::uint32_t f, std::uint32_t g) const
    {
        return (FaceCorners::common(corners_.of(f), corners_.of(g)).of_first & ~crowded_[f]) != 0;
    }

    /// Ascending.
    std::span<const Touching> of(std::uint32_t face) const
    {
        return {touching_.data() + begin_[face], touching_.data() + begin_[face + 1]};
    }

    std::size_t bytes() const
    {
        return touching_.capacity() * sizeof(Touching) + begin_.capacity() * sizeof(std::uint32_t) +
               crowded_.capacity();
    }

private:
    static constexpr std::uint32_t most_around = 64; // a corner

    const FaceCorners& corners_;
    std::vector<std::uint8_t> crowded_; // a face: bits of its corners
    std::vector<Touching> touching_;
    std::vector<std::uint32_t> begin_; // of each face's, and the end of the last
};

} // namespace visorder::detail
