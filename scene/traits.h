#pragma once

#include <cstddef>

namespace visorder {

class Scene;

/// What a scene is, decided exactly; what `auto` reads to choose a sorter. For a surface scene only `flat_cells`
/// (triangles without area) says something, and the rest is false or zero.
struct Traits {
    bool convex;            ///< the cells fill a convex body, without folds
    bool delaunay;          ///< tetrahedra whose circumspheres hold no point of the mesh strictly inside
    bool face_to_face;      ///< no two boundary faces lie in one plane and share area: cells touch in whole faces only
    bool planar_faces;      ///< the vertices of every face lie in one plane
    std::size_t flat_cells; ///< cells without volume
    std::size_t inverted_cells; ///< cells whose vertices stand in the reverse of VTK's order
    std::size_t folded_faces;   ///< faces that two cells on the same side of them share, which overlap there
    std::size_t crowded_faces;  ///< faces that more than two cells share, of which two overlap or are one cell twice
};

Traits derive_traits(const Scene& scene);

} // namespace visorder
