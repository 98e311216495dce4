#pragma once

#include "scene/face_loop.h"
#include "visorder/scene.h"

#include <vector>

namespace visorder::detail {

/// Two cells that overlap in space, and the plane that nearly separates them: of all planes through three vertices of
/// the two, the one that the cells reach least far beyond. An eye that sees a, b, c counterclockwise has `near` in
/// front of `far`, as far as one can say.
struct OverlapPlane {
    CellId near;
    CellId far;
    FaceTriple plane;
    double depth; ///< how far the cells reach beyond the plane, in units of their size
};

/// One per pair of `Scene::overlapping_cells`, by depth ascending: the best-founded first. Pairs too small for double
/// precision to tell have none.
std::vector<OverlapPlane> derive_overlap_planes(const Scene& scene);

} // namespace visorder::detail
