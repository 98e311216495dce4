#pragma once

#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/box.h"
#include "scene/circumspheres.h"
#include "scene/face_planes.h"
#include "scene/large_array.h"
#include "scene/mesh.h"
#include "scene/orientations.h"
#include "scene/overlap_planes.h"
#include "scene/structure.h"
#include "scene/traits.h"

#include <glm/vec3.hpp>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

namespace visorder {

/// What is ordered: a mesh, and the structures derived from it. Cells and points are renumbered along a space-filling
/// curve, so that neighbours in space are neighbours in memory: everything a Scene hands out speaks this inner
/// numbering, and `caller_cells` leads back to the numbering of the mesh it was made from. Each structure is derived
/// the first time something asks for it, once, and its time and bytes are recorded.
///
/// Immutable once made; any number of threads may use one Scene. References it hands out live as long as it does.
class Scene {
public:
    /// Throws InputError, naming the cell or point, if the mesh is not valid (see `validate`).
    explicit Scene(Mesh mesh);
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// The mesh in the inner numbering.
    const Mesh& mesh() const { return mesh_; }
    CellId cell_count() const { return static_cast<CellId>(mesh_.shapes.size()); }
    /// Whether the cells are triangles rather than solids.
    bool is_surface() const { return mesh_.shapes.front() == CellShape::triangle; }
    /// Whether all cells are tetrahedra.
    bool is_tetrahedral() const { return tetrahedral_; }
    const Box& bounds() const { return bounds_; }

    /// The diagonal of `bounds`; 1 where all points coincide, so that it may serve as a unit of length.
    double diameter() const;

    /// caller_cells()[i] is the number that inner cell i had in the mesh the Scene was made from; likewise for points.
    std::span<const CellId> caller_cells() const { return caller_cells_; }
    std::span<const PointId> caller_points() const { return caller_points_; }

    // Derived on demand; each throws InputError where the mesh has no such structure.
    const Orientations& orientations() const;
    const Adjacency& adjacency() const;
    const Boundary& boundary() const;
    const FacePlanes& face_planes() const;
    const LargeArray<glm::vec3>& centroids() const; ///< means of each cell's vertices, relative to the bounds' centre
    const Circumspheres& circumspheres() const;
    const Traits& traits() const;
    /// Pairs of cells whose interiors have a point in common: no order of them exists. See overlapping_cells.h.
    const std::vector<std::pair<CellId, CellId>>& overlapping_cells() const;

    /// What nearly separates each of these pairs. See overlap_planes.h.
    const std::vector<OverlapPlane>& overlap_planes() const;
    /// Of a scene of solids: where relations are sought that interior faces do not carry. See relation_faces.h.
    const std::vector<CellFace>& relation_faces() const;

    /// What has been derived so far, in the order in which it was.
    std::vector<StructureRecord> derived() const;

private:
    template <class T, class Make>
    const T& derive(const Derived<T>& slot, Structure structure, Make&& make) const;

    Mesh mesh_;
    LargeArray<CellId> caller_cells_;
    LargeArray<PointId> caller_points_;
    Box bounds_;
    bool tetrahedral_;

    Derived<Orientations> orientations_;
    Derived<Adjacency> adjacency_;
    Derived<Boundary> boundary_;
    Derived<FacePlanes> face_planes_;
    Derived<LargeArray<glm::vec3>> centroids_;
    Derived<Circumspheres> circumspheres_;
    Derived<Traits> traits_;
    Derived<std::vector<std::pair<CellId, CellId>>> overlapping_cells_;
    Derived<std::vector<OverlapPlane>> overlap_planes_;
    Derived<std::vector<CellFace>> relation_faces_;

    mutable std::mutex records_mutex_;
    mutable std::vector<StructureRecord> records_;
};

} // namespace visorder
