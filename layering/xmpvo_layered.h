#pragma once

#include "layering/layer_scan.h"
#include "layering/pixel_sequences.h"
#include "scene/face_planes.h"
#include "sorting/face_pairs.h"
#include "sorting/topological_sort.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"

#include <optional>
#include <span>
#include <vector>

namespace visorder::detail {

/// The discretised XMPVO (Krishnan, Silva, Wei 2002, section 4): one ray a pixel. The boundary faces are drawn, and at
/// each pixel they stand layer behind layer; where a ray leaves the mesh by one layer and comes back by the next, an
/// arrow leads from the owner of the one face to that of the other. The arrows, put to the exact predicates as `xmpvo`
/// does with what its rays find, go with the interior relations to the topological sort. No relation is wrong, but one
/// that no pixel shows is missing: what lies outside the view, and overlaps that fall between the sample points. Where
/// rays come back in a small part of the image only, that part is drawn again as large as the image.
/// Exact on convex meshes; elsewhere approximate.
///
/// Needs adjacency, boundary and face planes. Holds an OpenGL context. One `sort` at a time on one sorter, on any
/// thread.
class XmpvoLayered final : public Sorter {
public:
    /// Of images of `size` pixels, or of the view's size where that is 0. Throws InputError for a surface scene and,
    /// naming the cell, for a face that is not planar; GraphicsError where there is no OpenGL.
    XmpvoLayered(const Scene& scene, GlPlatform platform, glm::ivec2 size);

    Guarantee guarantee() const override;
    void sort(const View& view, Order& order) override;
    std::size_t bytes() const override;
    std::vector<Statistic> statistics() const override;

    /// The relations between boundary cells that the last `sort` found, ascending, each once.
    std::span<const Relation> relations() const { return relations_; }

private:
    PixelRectangle find_pairs(const glm::dmat4& world_to_clip, glm::ivec2 size);

    Scene scene_;
    glm::ivec2 size_;
    ItemMesh items_;
    Context context_;
    std::optional<ItemBuffer> buffer_;
    std::optional<PixelSequences> sequences_;
    ImageTriangles triangles_;
    FaceSigns signs_;
    std::vector<Sign> sides_;          // of the boundary faces
    std::vector<std::uint64_t> pairs_; // of boundary faces, exit << 32 | entry
    std::vector<Relation> relations_;
    TopologicalSort topological_sort_;
    std::vector<std::uint8_t> drawn_;
    LayerWork work_;
    std::size_t deepest_ = 0;
};

} // namespace visorder::detail
