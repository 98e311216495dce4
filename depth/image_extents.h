#pragma once

#include "parallel/large_array.h"
#include "visorder/box.h"
#include "visorder/scene.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// Where a cell lies in an image plane, and how far behind it, in units of the ranges of all cells in that plane: all
/// numbers are in [0, 1]. If one cell's `right` is less than another's `left` (or `top` than `bottom`, `far` than
/// `near`), so it is in truth; equal numbers say nothing.
struct Extent {
    CellId cell;
    std::uint32_t plane;
    float left, right, bottom, top, near, far;
};

/// The x, y and z extents of cells as an eye sees them, for the tests 1 to 3 of Newell's (Max, Williams and Silva 2000,
/// section III), and spheres around them for the tests 1' and 2'.
///
/// Along a direction there is one image plane. Around a position, rays go every way, and there are six, the sides of a
/// cube: each takes the rays of a quarter of the full view across and down, z is the distance along its normal, which
/// grows along every ray, and a cell has an extent in every plane that it may be seen in. The first points to the
/// middle of the scene, and from outside often holds all of it.
///
/// What is computed in floating point is widened by bounds of the errors before it is compared: a test that says no is
/// right. `evaluate` is one call at a time; between two of them any number of threads may ask.
class ImageExtents {
public:
    /// In parallel. `eye` is finite and not all zero.
    void evaluate(const Scene& scene, const glm::dvec4& eye);

    std::uint32_t plane_count() const { return plane_count_; }
    std::span<const Extent> all() const { return extents_; }
    std::span<const Extent> of(CellId cell) const
    {
        return {extents_.data() + begin_[cell], extents_.data() + begin_[cell + 1]};
    }

    /// A depth of the cell's farthest vertex that tells cells of all image planes apart, rounded.
    double farthest(CellId cell) const { return farthest_[cell]; }

    /// Test 1': the cones from the eye around the cells' spheres are certainly disjoint.
    bool cones_apart(CellId a, CellId b) const;
    /// Test 2': a's sphere is certainly disjoint from b's and lies behind it.
    bool sphere_behind(CellId a, CellId b) const;

    std::size_t bytes() const
    {
        return extents_.capacity() * sizeof(Extent) + begin_.capacity() * sizeof(std::size_t) +
               farthest_.capacity() * sizeof(double) + spheres_.capacity() * sizeof(Sphere);
    }

private:
    struct Sphere {
        glm::dvec3 centre; // from the eye, or from the middle of the scene, in the axes of the image planes
        double radius;
        glm::dvec3 axis; // of its cone: a unit vector, or the centre's place in the image
        double reach;    // half the cone's angle, or the radius of its image
    };

    bool parallel_ = false;
    std::uint32_t plane_count_ = 0;
    LargeArray<Extent> extents_;
    LargeArray<std::size_t> begin_; // of each cell's in extents_, and their end
    LargeArray<double> farthest_;
    LargeArray<Sphere> spheres_;
};

} // namespace visorder::detail
