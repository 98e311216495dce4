#pragma once

#include "visorder/read_mesh.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace visorder::detail {

/// What a file lists as a cell. Corners stand in VTK's order of the shape.
enum class ListedShape : std::uint8_t {
    empty,            ///< no cell at all
    lower,            ///< points and lines, whose corners need not be listed
    polygon,          ///< three corners or more, in their order around it
    strip,            ///< a strip of triangles
    tetrahedron,      ///
    pyramid,          ///
    wedge,            ///
    hexahedron,       ///
    pentagonal_prism, ///< ten corners: around one pentagon, then around the other
    hexagonal_prism,  ///< twelve corners, likewise
    convex_hull,      ///< the convex hull of its corners
    polyhedron,       ///< its "corners" are its faces: how many, then of each how many points it has, and those
};

struct ListedCell {
    ListedShape shape;
    bool higher_order = false; ///< has more points in the file than its corners, which alone are listed
    bool hidden = false;       ///< the file hides it, or has it twice
};

/// An array of numbers that a file has for its points or its cells.
struct FileArray {
    std::string name;
    bool on_cells;
    int components;
    bool holds_ids;
    /// The numbers, or magnitudes where there are several components; one for each point or cell that the file lists,
    /// NaN where it has none.
    std::function<std::vector<double>()> values;
    bool active = false;   ///< the file says that it is the one to look at
    std::string type = ""; ///< of its numbers
};

/// What a file lists, before a mesh is made of it.
struct FileGrid {
    std::filesystem::path path;
    std::vector<glm::dvec3> points;
    /// Where the points of each piece begin, if the file comes in pieces: pieces meet where points are equal.
    std::vector<std::size_t> pieces;
    std::vector<ListedCell> cells;
    std::vector<std::size_t> ends;     ///< for each cell, where its corners end in `corners`
    std::vector<std::int64_t> corners; ///< indices into points, not checked yet
    std::vector<MeshBlock> blocks;
    std::vector<FileArray> arrays;
    std::string default_array; ///< the one that is taken if none is named; empty: to be chosen by kind
    std::vector<std::string> notes;

    void add(ListedCell cell, std::span<const std::int64_t> cell_corners)
    {
        cells.push_back(cell);
        corners.insert(corners.end(), cell_corners.begin(), cell_corners.end());
        ends.push_back(corners.size());
    }
    std::span<const std::int64_t> cell(std::size_t i) const
    {
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return {corners.data() + begin, corners.data() + ends[i]};
    }
};

/// Makes a mesh of what a file lists. Pieces are joined, and all points if `options.weld`, before cells are cut up, so
/// that all cells cut faces they share alike. Prisms, convex hulls and polyhedra become tetrahedra, cut by the rule of
/// `subdivide`; polygons and strips become triangles; in a file with solids, surface cells are left out. Cell data is
/// averaged to points; points that no cell uses are dropped. Notes tell of each.
///
/// Throws InputError, naming the file and the cell (counted from 0 over all that the file lists), where a cell cannot
/// be taken, and where there is no array of the name asked for.
MeshFile mesh_of(FileGrid&& grid, const ReadOptions& options);

} // namespace visorder::detail
