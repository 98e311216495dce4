#include "scene/scene.h"

#include "scene/numbering.h"
#include "scene/overlapping_cells.h"
#include "scene/relation_faces.h"
#include "scene/stopwatch.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder {

namespace {

template <class Array>
std::size_t size_of(const Array& array)
{
    return array.capacity() * sizeof(array[0]);
}

std::size_t bytes(const Orientations& x)
{
    return size_of(x.sign);
}
std::size_t bytes(const Adjacency& x)
{
    return size_of(x.neighbour) + size_of(x.interior) + size_of(x.folded) + size_of(x.crowded);
}
std::size_t bytes(const Boundary& x)
{
    return size_of(x.faces) + size_of(x.component);
}
std::size_t bytes(const FacePlanes& x)
{
    return size_of(x.plane);
}
std::size_t bytes(const LargeArray<glm::vec3>& x)
{
    return size_of(x);
}
std::size_t bytes(const Circumspheres& x)
{
    return size_of(x.centre) + size_of(x.constant);
}
std::size_t bytes(const std::vector<std::pair<CellId, CellId>>& x)
{
    return size_of(x);
}
std::size_t bytes(const std::vector<OverlapPlane>& x)
{
    return size_of(x);
}
std::size_t bytes(const std::vector<CellFace>& x)
{
    return size_of(x);
}
std::size_t bytes(const Traits&)
{
    return sizeof(Traits);
}

LargeArray<glm::vec3> derive_centroids(const Scene& scene)
{
    const Mesh& mesh = scene.mesh();
    const glm::dvec3 origin = scene.bounds().middle();
    LargeArray<glm::vec3> centroids(scene.cell_count());
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, scene.cell_count(), 4096), [&](const auto& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell) {
            glm::dvec3 sum(0);
            for (PointId p : mesh.cell(cell))
                sum += mesh.points[p] - origin;
            centroids[cell] = glm::vec3(sum / static_cast<double>(mesh.cell(cell).size()));
        }
    });
    return centroids;
}

} // namespace

template <class T, class Make>
const T& Scene::derive(const Derived<T>& slot, Structure structure, Make&& make) const
{
    return slot.get([&] {
        Stopwatch watch;
        T value = make();
        const std::lock_guard lock(records_mutex_);
        records_.push_back({structure, watch.lap(), bytes(value)});
        return value;
    });
}

Scene::Scene(Mesh mesh) : mesh_(std::move(mesh))
{
    validate(mesh_);
    Stopwatch watch;
    Numbering numbering = renumber(mesh_);
    caller_cells_ = std::move(numbering.caller_cells);
    caller_points_ = std::move(numbering.caller_points);
    for (const glm::dvec3& p : mesh_.points)
        bounds_.add(p);
    tetrahedral_ = std::all_of(mesh_.shapes.begin(), mesh_.shapes.end(),
                               [](CellShape shape) { return shape == CellShape::tetrahedron; });
    records_.push_back({Structure::numbering, watch.lap(), size_of(caller_cells_) + size_of(caller_points_)});
}

const Adjacency& Scene::adjacency() const
{
    if (!is_surface())
        orientations();
    return derive(adjacency_, Structure::adjacency, [&] { return derive_adjacency(*this); });
}

const Orientations& Scene::orientations() const
{
    return derive(orientations_, Structure::orientations, [&] { return derive_orientations(*this); });
}

const Boundary& Scene::boundary() const
{
    adjacency();
    return derive(boundary_, Structure::boundary, [&] { return derive_boundary(*this); });
}

const FacePlanes& Scene::face_planes() const
{
    adjacency();
    return derive(face_planes_, Structure::face_planes, [&] { return derive_face_planes(*this); });
}

const LargeArray<glm::vec3>& Scene::centroids() const
{
    return derive(centroids_, Structure::centroids, [&] { return derive_centroids(*this); });
}

const Circumspheres& Scene::circumspheres() const
{
    return derive(circumspheres_, Structure::circumspheres, [&] { return derive_circumspheres(*this); });
}

const Traits& Scene::traits() const
{
    // Derived first, so that the time of each is its own.
    orientations();
    boundary();
    return derive(traits_, Structure::traits, [&] { return derive_traits(*this); });
}

const std::vector<std::pair<CellId, CellId>>& Scene::overlapping_cells() const
{
    boundary();
    return derive(overlapping_cells_, Structure::overlapping_cells, [&] { return derive_overlapping_cells(*this); });
}

const std::vector<OverlapPlane>& Scene::overlap_planes() const
{
    overlapping_cells();
    return derive(overlap_planes_, Structure::overlap_planes, [&] { return derive_overlap_planes(*this); });
}

const std::vector<CellFace>& Scene::relation_faces() const
{
    overlapping_cells();
    return derive(relation_faces_, Structure::relation_faces, [&] { return derive_relation_faces(*this); });
}

std::vector<StructureRecord> Scene::derived() const
{
    const std::lock_guard lock(records_mutex_);
    return records_;
}

double Scene::diameter() const
{
    const double diagonal = glm::length(bounds_.max - bounds_.min);
    return diagonal > 0 ? diagonal : 1;
}

} // namespace visorder
