#pragma once

#include "geometry/exact_predicates.h"
#include "geometry/unit_planes.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "visorder/scene.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// A binary space partition (Fuchs, Kedem, Naylor 1980; Comba et al. 1999) of the relation faces of a scene, which are
/// its boundary faces where no cells overlap, or of the triangles of a surface. Every inner node has the plane of one
/// of the faces, chosen among a sample by how many others it splits and how evenly it divides them; it keeps the faces
/// that lie in this plane. A leaf keeps a few faces without an order of their own. Depends on the points alone: the
/// eye, scalars and transfer functions may change.
///
/// Splits are combinatorial: a face that a plane may cut goes to both sides whole. It stays out of a side only where
/// its vertices prove it, exactly, or where what earlier cuts leave of it, computed with a proved margin, lies clearly
/// on the other: so every face is in each leaf whose region it meets, and perhaps in some more.
///
/// Immutable; any number of threads may walk it.
class BspTree {
public:
    /// The same tree for the same scene and seed on any number of threads.
    BspTree(const Scene& scene, std::uint64_t seed);

    /// The faces: the scene's relation faces, or its triangles as face 0 of each.
    std::span<const CellFace> faces() const { return faces_; }
    /// In how many groups each of them is; none for a face without area.
    std::span<const std::uint32_t> group_counts() const { return group_counts_; }

    /// Calls visit(group) for the faces of each leaf and of each inner node's plane, as indices into `faces`, back to
    /// front: where a face in one group is nearer than a face in another one on a ray from the eye that meets the
    /// regions of both, the farther one's group comes first. Linear in the nodes.
    template <class Visit>
    void walk(const glm::dvec4& eye, Visit&& visit) const;

    std::size_t node_count() const { return nodes_.size(); }
    /// Inner nodes on the longest path.
    std::size_t depth() const { return depth_; }
    /// How many more faces the groups hold than there are.
    std::size_t split_count() const { return groups_.size() - placed_; }
    std::size_t bytes() const;

private:
    static constexpr std::uint32_t none = 0xffffffffu;

    struct Node {
        std::uint32_t begin, end; // of its group in groups_
        PointId a, b, c;          // of its plane, if it is an inner node
        std::uint32_t positive;   // the child on the side that sees a, b, c counterclockwise, or none
        std::uint32_t negative;
    };

    Sign side(std::uint32_t index, const glm::dvec4& eye, const UnitEye& unit) const
    {
        if (const Sign side = unit.sure_side(planes_[index]); side != Sign::zero)
            return side;
        const Node& node = nodes_[index];
        const auto& points = scene_.mesh().points;
        return side_of_plane(points[node.a], points[node.b], points[node.c], eye);
    }

    friend class BspConstruction;

    Scene scene_;
    std::vector<CellFace> faces_;
    std::vector<std::uint32_t> group_counts_;
    std::vector<Node> nodes_; // the root first, children after their parents
    UnitFrame frame_{};
    std::vector<UnitPlane> planes_; // of the nodes; of a leaf, of no meaning
    std::vector<std::uint32_t> groups_;
    std::size_t depth_ = 0;
    std::size_t placed_ = 0; // faces that are in some group
};

template <class Visit>
void BspTree::walk(const glm::dvec4& eye, Visit&& visit) const
{
    if (nodes_.empty())
        return;
    struct Step {
        std::uint32_t node;
        bool group_only; // its far side has been walked
    };
    const UnitEye unit(frame_, eye);
    std::vector<Step> stack{{0, false}};
    while (!stack.empty()) {
        const auto [index, group_only] = stack.back();
        stack.pop_back();
        const Node& node = nodes_[index];
        if (!group_only && (node.positive != none || node.negative != none)) {
            // From within the plane no ray crosses it: either side may come first.
            const bool in_front = side(index, eye, unit) != Sign::negative;
            const std::uint32_t near = in_front ? node.positive : node.negative;
            const std::uint32_t far = in_front ? node.negative : node.positive;
            if (near != none)
                stack.push_back({near, false});
            stack.push_back({index, true});
            if (far != none)
                stack.push_back({far, false});
            continue;
        }
        visit(std::span<const std::uint32_t>(groups_.data() + node.begin, node.end - node.begin));
    }
}

} // namespace visorder::detail
