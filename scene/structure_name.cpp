#include "visorder/scene.h"

namespace visorder {

using namespace detail;

const char* name(Structure structure)
{
    switch (structure) {
    case Structure::numbering:
        return "numbering";
    case Structure::orientations:
        return "orientations";
    case Structure::adjacency:
        return "adjacency";
    case Structure::boundary:
        return "boundary";
    case Structure::face_planes:
        return "face planes";
    case Structure::centroids:
        return "centroids";
    case Structure::circumspheres:
        return "circumspheres";
    case Structure::traits:
        return "traits";
    case Structure::overlapping_cells:
        return "overlaps";
    case Structure::overlap_planes:
        return "overlap planes";
    case Structure::relation_faces:
        return "relation faces";
    }
    return "";
}

} // namespace visorder
