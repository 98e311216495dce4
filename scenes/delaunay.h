#pragma once

#include "visorder/mesh.h"

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

namespace visorder::scenes {

/// The Delaunay tetrahedralisation of the points, which it renumbers along a space-filling curve; no scalars yet. The
/// cells stand in VTK's vertex order with their lowest vertex first, ascending, so that the mesh depends on the points
/// alone and not on how they were triangulated (where five of them lie on one empty sphere, on that too). Of equal
/// points one is kept. Fewer than four points that span space give a mesh without cells.
Mesh delaunay_mesh(std::vector<glm::dvec3> points);

/// The vertices of a tetrahedron.
using Corners = std::array<glm::dvec3, 4>;

/// Leaves of the cells, which are tetrahedra, those for which `keep` is true, and of the points those in use; both stay
/// in order.
void keep_cells(Mesh& mesh, const std::function<bool(const Corners&)>& keep);

} // namespace visorder::scenes
