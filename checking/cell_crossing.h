#pragma once

#include <array>

namespace visorder::detail {

/// A vertex as seen from a ray: x and y are its offsets from the ray, both 0 on it; w says how they change as the ray
/// moves to the side (by (dx, dy): by -w dx and -w dy).
struct SeenVertex {
    double x, y, w;
    double depth;
    double scalar;
};

/// The stretch of a ray inside a cell, near end first.
struct Crossing {
    double depth[2];
    double scalar[2];
};

/// Finds where a line passes through a tetrahedron, and the scalars there. Vertices stand in ascending order of their
/// numbers in the mesh. Returns false if it does not, or along no length.
///
/// Each face is hit or not by the signs of which side the line passes its edges on. The signs are exact for the given
/// offsets, and ties are broken as if the line were moved aside by (e, e^2), e infinitely small. So what neighbours say
/// of the edges and vertices that they share always fits: no line slips between two cells, and one that runs along a
/// face or an edge is in one of the cells around it, where any is on the side that it would be moved to. Depths are
/// means of the vertices' depths with weights of one sign: no cancellation, however thin the cell.
bool cross(const std::array<SeenVertex, 4>& vertices, Crossing& crossing);

} // namespace visorder::detail
