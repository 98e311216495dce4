#pragma once

#include "visorder/mesh.h"

#include <cstddef>
#include <cstdint>

namespace visorder::scenes {

// The makers of the generated scenes. Each takes the number of tetrahedra (or triangles) asked for, not less than its
// family's minimum, and makes about as many, or the hexahedra that become about as many, six each. Scalars come later.

/// The Delaunay tetrahedralisation of random points in the unit cube. Convex, Delaunay, face to face, acyclic.
Mesh delaunay_scene(std::size_t cells, std::uint64_t seed);

/// Half of a `delaunay` scene: the cells whose centres lie on one side of a gyroid with two periods across the cube.
/// Rays leave the mesh and come back several times; some cells touch the rest in an edge or a point alone. Not convex;
/// being cells of a Delaunay mesh, Delaunay and acyclic; face to face.
Mesh carved_scene(std::size_t cells, std::uint64_t seed);

/// The Delaunay tetrahedralisation of a regular lattice with points moved by up to a billionth of the spacing: beside
/// the tetrahedra that fill the cubes, very many that are flat but for that, inside and all over the hull. None is
/// exactly flat. Convex, Delaunay, face to face, acyclic.
Mesh sliver_scene(std::size_t cells, std::uint64_t seed);

/// A `delaunay` scene around (1e7, -2e7, 3e7), where doubles lie 2e-9 to 4e-9 apart, triangulated after rounding there.
/// Convex, Delaunay, face to face, acyclic.
Mesh offset_scene(std::size_t cells, std::uint64_t seed);

/// From a `delaunay` scene the island of cells with all vertices closer to the middle than 0.2, and the shell of those
/// with none closer than 0.3: two bodies without a common point, one inside the other. Not convex; being cells of a
/// Delaunay mesh, Delaunay and acyclic; face to face.
Mesh cavity_scene(std::size_t cells, std::uint64_t seed);

/// Two blocks that touch in the plane x = 1, exactly, without a common point or face: each a box, the Delaunay
/// tetrahedralisation of its corners and of random points on its edges, on its sides and inside. The second is shifted
/// along the common plane, so that each also reaches beyond the other. Each block is convex, Delaunay and face to face;
/// the two together are none of these, but acyclic, since a plane divides them.
Mesh contact_scene(std::size_t cells, std::uint64_t seed);

/// Equal cubes in rows, numbered lexicographically, x fastest, as are the points. Every coordinate is a multiple of one
/// power of two, so that faces are exactly planar and whole rows of cells tie in every key. Convex, face to face,
/// acyclic; so are the tetrahedra of a subdivision that splits at lowest vertices.
Mesh grid_scene(std::size_t cells, std::uint64_t seed);

/// The curvilinear grid around a blunt fin on a plate: a half-round leading edge of radius 1 with straight sides behind
/// it, wrapped by C-shaped grid lines that grow apart geometrically, and spanwise layers that grow away from the plate.
/// After the grid of NASA's blunt fin (Hung and Buning 1984), which has about the same proportions. Hexahedra with
/// exactly planar faces. Not convex; face to face; acyclic also when subdivided at lowest vertices.
Mesh fin_scene(std::size_t cells, std::uint64_t seed);

/// The O-grid around a cylinder: radii and layers that grow geometrically, closed around without a seam, by index.
/// Hexahedra with exactly planar faces. Not convex (the cylinder is a hole right through); face to face; acyclic also
/// when subdivided at lowest vertices.
Mesh post_scene(std::size_t cells, std::uint64_t seed);

/// A gear wheel around the z axis: a bore, a rim of rings of cells, and sixteen teeth with gaps as wide between them.
/// Hexahedra with exactly planar faces. Not convex; face to face; acyclic also when subdivided at lowest vertices, for
/// the reason that `post` is.
Mesh gear_scene(std::size_t cells, std::uint64_t seed);

/// `gear`, wound around the axis by half a tooth's pitch from one side of the wheel to the other. Hexahedra whose faces
/// are not planar, and so to be subdivided: the tetrahedra meet face to face and do not overlap. Not convex. The faces
/// between the columns of cells all lean the same way, so that from eyes near the axis rings of hexahedra are cycles.
/// Rings of tetrahedra are not, since the lowest vertices that they are cut at change sides where the numbers around
/// the axis begin again; no cycle of tetrahedra is known.
Mesh helical_gear_scene(std::size_t cells, std::uint64_t seed);

/// A block with a square array of straight square channels along z, ever more of them in larger scenes; walls and
/// channels are two cells wide. A ray across leaves and comes back once per channel. Coordinates are whole numbers.
/// Hexahedra with exactly planar faces. Not convex; face to face; acyclic also when subdivided at lowest vertices.
Mesh reactor_scene(std::size_t cells, std::uint64_t seed);

/// Two rings with square sections, each through the middle of the other's hole, without touching: the first around the
/// z axis, the second around a parallel to the y axis. Hexahedra with exactly planar faces. Not convex; face to face;
/// acyclic also when subdivided at lowest vertices.
Mesh tori_scene(std::size_t cells, std::uint64_t seed);

/// Three rings of cells, each a cycle that faces show: from every direction, hence from every eye far away, the cells
/// of at least one ring occlude each other all the way around. Face to face within each ring; no cells overlap.
/// Neither convex nor acyclic.
Mesh pinwheel_scene(std::size_t cells, std::uint64_t seed);

// Surface scenes. Triangles of closed surfaces are counterclockwise from outside.

/// A unit sphere: an icosahedron whose faces are cut into equally many triangles each and carried outwards. Closed;
/// acyclic.
Mesh sphere_scene(std::size_t cells, std::uint64_t seed);

/// Five such spheres around one middle with equal distances, triangles about equally large. Closed; the surfaces do not
/// meet; acyclic.
Mesh shells_scene(std::size_t cells, std::uint64_t seed);

/// A tube around a trefoil knot. Closed; it does not pass through itself.
Mesh knot_scene(std::size_t cells, std::uint64_t seed);

/// Rectangles of two triangles each, all of one size, at random places in the unit cube and turned at random. Each
/// passes through two others on average, however many there are; such triangles have no order. The others, too, may
/// occlude each other in cycles.
Mesh cards_scene(std::size_t cells, std::uint64_t seed);

} // namespace visorder::scenes
