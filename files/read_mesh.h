#pragma once

#include "files/mesh_file.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace visorder {

/// Reads a mesh, in a format chosen by the ending of the file's name:
/// - VTK's XML files (.vtu, .vts, .vtr, .vti, .vtp), those that name others as pieces, blocks or time steps (.pvtu and
///   kin, .vtm, .vtmb, .vtpc, .vtpd, .pvd), and legacy files of any kind of grid (.vtk);
/// - Exodus II (.ex2, .ex2v2, .e, .exo, .g, .gen, .exoII, .exii): all element blocks, without displacements;
/// - Gmsh (.msh, versions 1, 2, 4.0 and 4.1, text and binary) and MEDIT (.mesh, text);
/// - Plot3D (NAMExyz.bin, .xyz, .x, .p3d), of any layout (see plot3d_layout.h), with its solution beside it;
/// - the polygons of .obj, .off, .ply and .stl.
/// Files of one of these formats, except those that name others, may be compressed by gzip (.gz).
///
/// Of a file with time steps one is taken (`options.time`). Pieces and blocks with points of their own are joined where
/// points are exactly equal; an array that some blocks or pieces alone have is NaN elsewhere. Prisms over pentagons and
/// hexagons, convex point sets and polyhedra are cut into tetrahedra (see `cut_into_tetrahedra`).
///
/// Cells keep the order of the file. Of cells of higher order the corners are taken, cell data is averaged to points,
/// points that no cell uses and cells that the file hides are left out. In a file with solids, cells of lower dimension
/// are left out; a file of surface cells alone becomes a surface mesh, split into triangles. `notes` tells of each of
/// these. The mesh is valid (see `validate`).
///
/// Throws InputError, naming the file, for one that is missing, damaged or of an unknown ending, that has no cells or a
/// solid that cannot be taken (of an unknown type, or a polyhedron with a dent that hides a part of it), or has no
/// array named `options.scalar`; for one whose reader crashes, or takes more time or memory than `limits_for` allows;
/// and where the program for that cannot be found or started (see reader_process.h). Thread-safe. Without
/// `options.isolated`, VTK reads one file at a time, and meanwhile its messages, those of other threads too, are
/// collected rather than shown.
MeshFile read_mesh(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same from the bytes of a file in memory, which are not compressed: in the formats that VTK has no part in.
/// `name` tells the format, messages, and where further files are looked for.
MeshFile read_mesh_content(const std::filesystem::path& name, std::string_view content,
                           const ReadOptions& options = {});

/// The endings of file names that `read_mesh` takes.
std::vector<std::string> mesh_file_endings();

} // namespace visorder
