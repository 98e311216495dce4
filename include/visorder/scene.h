#pragma once

#include "visorder/box.h"
#include "visorder/mesh.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace visorder {

namespace detail {
struct Adjacency;
struct Boundary;
struct CellFace;
struct Circumspheres;
struct FacePlanes;
struct Orientations;
struct OverlapPlane;
struct SceneData;
template <class T>
struct LargeAllocator;
} // namespace detail

/// What a Scene derives from its mesh when first asked, once.
enum class Structure {
    numbering,
    orientations,
    adjacency,
    boundary,
    face_planes,
    centroids,
    circumspheres,
    traits,
    overlapping_cells,
    overlap_planes,
    relation_faces
};

const char* name(Structure structure);

/// What deriving a structure cost.
struct StructureRecord {
    Structure structure;
    double seconds;    ///< its own, without the structures it rests on
    std::size_t bytes; ///< held while the Scene lives
};

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

/// What is ordered: a mesh, and the structures derived from it. Cells and points are renumbered along a space-filling
/// curve, so that neighbours in space are neighbours in memory: everything a Scene hands out speaks this inner
/// numbering, and `caller_cells` leads back to the numbering of the mesh it was made from. Each structure is derived
/// the first time something asks for it, once, and its time and bytes are recorded.
///
/// A handle to something immutable: copies are cheap and share it, it lives as long as one of them, and what one hands
/// out lives as long. Sorters, checkers and renderers keep a copy of their own. Any number of threads may use one
/// Scene.
class Scene {
public:
    /// Throws InputError, naming the cell or point, if the mesh is not valid (see `validate`).
    explicit Scene(Mesh mesh);

    /// The mesh in the inner numbering.
    const Mesh& mesh() const { return *mesh_; }
    CellId cell_count() const { return static_cast<CellId>(mesh_->shapes.size()); }
    /// Whether the cells are triangles rather than solids.
    bool is_surface() const { return mesh_->shapes.front() == CellShape::triangle; }
    /// Whether all cells are tetrahedra.
    bool is_tetrahedral() const;
    const Box& bounds() const;

    /// The diagonal of `bounds`; 1 where all points coincide, so that it may serve as a unit of length.
    double diameter() const;

    /// caller_cells()[i] is the number that inner cell i had in the mesh the Scene was made from; likewise for points.
    std::span<const CellId> caller_cells() const;
    std::span<const PointId> caller_points() const;

    const Traits& traits() const;
    /// Pairs of cells whose interiors have a point in common: no order of them exists. Ascending, as each pair is.
    const std::vector<std::pair<CellId, CellId>>& overlapping_cells() const;

    /// What has been derived so far, in the order in which it was.
    std::vector<StructureRecord> derived() const;

    // Structures that the library's own modules read, whose types are not part of its interface. Each throws InputError
    // where the mesh has no such structure.
    const detail::Orientations& orientations() const;
    const detail::Adjacency& adjacency() const;
    const detail::Boundary& boundary() const;
    const detail::FacePlanes& face_planes() const;
    /// Means of each cell's vertices, relative to the middle of the bounds.
    const std::vector<glm::vec3, detail::LargeAllocator<glm::vec3>>& centroids() const;
    const detail::Circumspheres& circumspheres() const;
    /// What nearly separates each pair of overlapping cells.
    const std::vector<detail::OverlapPlane>& overlap_planes() const;
    /// Of a scene of solids: where relations are sought that interior faces do not carry.
    const std::vector<detail::CellFace>& relation_faces() const;

private:
    std::shared_ptr<detail::SceneData> data_;
    const Mesh* mesh_; // that of data_
};

} // namespace visorder
