#pragma once

#include "bsp/face_corners.h"
#include "parallel/large_array.h"
#include "scene/adjacency.h"
#include "visorder/scene.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace visorder::detail {

/// What single precision can tell for sure.
enum class Sure { no, yes, unknown };

/// On which sides of each other's planes the boundary faces of a scene lie, in single precision, as FaceSigns has it of
/// the eye: no eye changes that. Immutable.
class CornerHeights {
public:
    /// Of a surface, and where no face has an area, nothing is known. `corners` must live as long as this.
    CornerHeights(const Scene& scene, std::span<const CellFace> faces, const FaceCorners& corners);

    /// Whether exit face f is nearer than entry face g on the rays that meet both, if there are any. Sure where all of
    /// g lies weakly on one side of f's plane, or f of g's: f is seen from its cell's side, g from outside its cell.
    Sure nearer(std::uint32_t f, std::uint32_t g) const;

    /// Whether each of two faces with an edge in common has, for sure, all its other corners outside the other one's
    /// plane.
    bool face_each_other(std::uint32_t f, std::uint32_t g) const;

    /// Bits of a face's corners that lie for sure outside and inside a plane.
    struct Sides {
        unsigned outside, inside;
    };
    /// Of face g's corners, with respect to the plane of f.
    Sides sides(std::uint32_t f, std::uint32_t g) const { return sides(records_[f], records_[g]); }

    /// Has fetched what `nearer` reads of a face.
    void prefetch(std::uint32_t face) const
    {
        __builtin_prefetch(records_.data() + face);
        __builtin_prefetch(&corners_.of(face));
    }

    std::size_t bytes() const { return records_.capacity() * sizeof(Record); }

private:
    // Corners in unit coordinates (FacePlanes), and the face's outward plane.
    struct alignas(64) Record {
        float x[4], y[4], z[4];
        float plane[4];
    };
    static Sides sides(const Record& plane, const Record& corners);

    const FaceCorners& corners_;
    LargeArray<Record> records_;
};

} // namespace visorder::detail
