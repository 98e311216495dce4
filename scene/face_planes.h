#pragma once

#include "geometry/exact_predicates.h"
#include "geometry/unit_planes.h"
#include "parallel/large_array.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <cstdint>
#include <glm/vec4.hpp>
#include <span>

namespace visorder::detail {

/// The planes of all faces in single precision, one block per cell, for the filter of FaceSigns: block i holds the x of
/// the normals of its faces, then the y, the z, and the offsets, `row_length` of each; normals point outward. Both
/// cells of a face hold the same numbers with opposite signs. A plane that single precision cannot stand for (of a
/// needle, of a flat cell, of a face that the shape does not have) is all zeros: questions about it go to
/// `exact_face_side`.
struct FacePlanes {
    int row_length;
    LargeArray<float> plane; ///< 4 * row_length a cell
    UnitFrame frame;         ///< of the planes
};

/// Throws InputError, naming the cell, where a face is not planar, and for a surface scene.
FacePlanes derive_face_planes(const Scene& scene);

/// On which side of the plane of face `face` of `cell` the eye lies: `positive` strictly outside of the cell (an entry
/// face), `negative` strictly inside (an exit face), `zero` edge-on. Exact. A face of a flat cell is seen as the solid
/// neighbour's on its other side; `zero` where there is none, and for a collapsed face.
Sign exact_face_side(const Scene& scene, CellId cell, int face, const glm::dvec4& eye);

/// The side of every face of every cell at one eye, decided exactly: a single-precision filter with a proved error
/// bound, a cell's faces at once, and `exact_face_side` for what it leaves open. Reusable from eye to eye; one
/// `evaluate` at a time.
class FaceSigns {
public:
    void evaluate(const Scene& scene, const glm::dvec4& eye);

    /// A cell's faces as bits, face 0 lowest: those with the eye strictly outside, and those with it strictly inside.
    /// Boundary faces are included.
    std::uint32_t entry(CellId cell) const { return bits_[cell] & 0xffu; }
    std::uint32_t exit(CellId cell) const { return std::uint32_t{bits_[cell]} >> 8; }

    std::size_t bytes() const { return bits_.capacity() * sizeof(std::uint16_t); }

private:
    LargeArray<std::uint16_t> bits_; // entry | exit << 8 of every cell
};

} // namespace visorder::detail
