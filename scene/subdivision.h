#pragma once

#include "scene/mesh.h"

#include <vector>

namespace visorder {

/// The result of `subdivide`: tetrahedra, and for each the cell that it is part of.
struct Subdivision {
    Mesh mesh;
    std::vector<CellId> cell_of; ///< ascending: the parts of one cell stand together, in the order of the cells
};

/// Consistent subdivision of zoo cells into tetrahedra by the smallest-vertex rule (Max, Williams and Silva 2000,
/// Approximate volume rendering for curvilinear and unstructured grids by hardware-assisted polyhedron projection,
/// section IV; a simplification of Nielson and Sung 1997): the diagonal of each quadrilateral starts at its smallest
/// vertex index, so that two cells that share a quadrilateral always cut it the same way. A pyramid becomes two
/// tetrahedra, a wedge three, a hexahedron five or six.
///
/// Points and scalars are unchanged; triangles and tetrahedra pass through. The tetrahedra of a cell whose vertices
/// stand in VTK's order stand in VTK's order too. A collapsed cell (with repeated vertex indices) gives as many
/// tetrahedra as any, some of them with repeated vertices.
///
/// Throws InputError for a mesh that is not valid (see `validate`), and where the parts would be too many for a mesh.
Subdivision subdivide(const Mesh& mesh);

} // namespace visorder
