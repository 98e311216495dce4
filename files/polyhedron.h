#pragma once

#include "visorder/mesh.h"

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// The faces of a solid: polygons of three corners or more, in their order around each.
struct PolyhedronFaces {
    std::vector<PointId> corners;
    std::vector<std::size_t> ends; ///< for each face, where its corners end

    std::size_t count() const { return ends.size(); }
    std::span<const PointId> face(std::size_t i) const
    {
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return {corners.data() + begin, corners.data() + ends[i]};
    }
    /// Adds a face, but each corner only once, and no face of fewer than three that differ.
    void add(std::span<const PointId> face_corners);
    void clear()
    {
        corners.clear();
        ends.clear();
    }
};

/// The faces of a prism over a polygon of `sides` sides: `corners` are those around one end, then those around the
/// other, both counterclockwise as seen from the other end's side to the first, as in VTK's prisms.
void add_prism_faces(std::span<const PointId> corners, PolyhedronFaces& faces);

/// Turns faces so that all are counterclockwise from the same side, the first as it is. False if they do not close a
/// single surface: each edge has to have two faces.
bool orient_faces(PolyhedronFaces& faces);

using TetrahedronCorners = std::array<PointId, 4>;

/// Cuts a solid into tetrahedra by the smallest-vertex rule of `subdivide`: a face is a fan of triangles around its
/// smallest vertex, so that two cells that share it cut it alike, and the tetrahedra join the smallest vertex of all to
/// the triangles of the faces that it is not part of. They are in VTK's order if faces are counterclockwise from
/// outside. Appends to `parts`.
void cut_into_tetrahedra(const PolyhedronFaces& faces, std::vector<TetrahedronCorners>& parts);

/// The six-fold signed volume, positive in VTK's order, rounded.
double sixfold_volume(const TetrahedronCorners& corners, std::span<const glm::dvec3> points);

} // namespace visorder::detail
