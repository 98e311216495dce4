#pragma once

#include "layering/layer_extraction.h"
#include "visorder/mesh.h"
#include "visorder/view.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace visorder::bench {

using namespace detail;

/// A triangle at a sample point.
struct TrueFragment {
    std::uint32_t pixel; ///< y * width + x, rows from the bottom up
    CellId triangle;
    double distance; ///< along the ray; in a parallel view from anywhere, so that it may be negative
};

/// All triangles of a mesh at all sample points of an image that they cover, pixel by pixel and nearest first: rays in
/// world coordinates through the centres of the pixels, met with the triangles in double precision. Shares nothing with
/// what draws them.
std::vector<TrueFragment> true_fragments(const Mesh& mesh, const View& view, glm::ivec2 size);

/// How far two triangles must be apart along a ray, so that 32-bit depths tell for sure which one is nearer: 2^-22 of
/// the bounding box's diagonal.
double tie_distance(const Mesh& mesh);

/// The layers of an image held against the depths of its triangles.
struct LayerCheck {
    std::size_t samples = 0;   ///< sample points that some triangle covers
    std::size_t fragments = 0; ///< triangles at sample points
    std::size_t pairs = 0;     ///< pairs of triangles at one sample point whose layers were compared
    std::size_t in_cycles = 0; ///< pairs of which both are of one cycle, not compared
    std::size_t ties = 0;      ///< pairs nearer to each other than 32-bit depths tell for sure, not compared
    std::size_t wrong = 0;     ///< pairs of which the nearer one has not the lower layer
    std::size_t missed = 0;    ///< fragments of triangles that are said to cover no sample point, or to be edge-on
    std::vector<std::string> witnesses; ///< of the first few `wrong` and `missed`
};

/// What a triangle is called in a witness.
using TriangleName = std::function<std::string(CellId)>;

/// Holds `layers`, whose items are the cells of a mesh of triangles, against the true fragments at every sample point
/// of the image.
LayerCheck check_layers(
    const Mesh& mesh, const View& view, glm::ivec2 size, const Layers& layers,
    const TriangleName& name = [](CellId triangle) { return "triangle " + std::to_string(triangle); });

} // namespace visorder::bench
