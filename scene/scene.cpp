#include "visorder/scene.h"

#include "parallel/large_array.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/circumspheres.h"
#include "scene/derived.h"
#include "scene/face_planes.h"
#include "scene/numbering.h"
#include "scene/orientations.h"
#include "scene/overlap_planes.h"
#include "scene/overlapping_cells.h"
#include "scene/relation_faces.h"
#include "scene/stopwatch.h"
#include "scene/traits.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <mutex>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder {

namespace detail {

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

/// What a Scene refers to.
struct SceneData {
    Mesh mesh;
    LargeArray<CellId> caller_cells;
    LargeArray<PointId> caller_points;
    Box bounds;
    bool tetrahedral = false;

    Derived<Orientations> orientations;
    Derived<Adjacency> adjacency;
    Derived<Boundary> boundary;
    Derived<FacePlanes> face_planes;
    Derived<LargeArray<glm::vec3>> centroids;
    Derived<Circumspheres> circumspheres;
    Derived<Traits> traits;
    Derived<std::vector<std::pair<CellId, CellId>>> overlapping_cells;
    Derived<std::vector<OverlapPlane>> overlap_planes;
    Derived<std::vector<CellFace>> relation_faces;

    std::mutex records_mutex;
    std::vector<StructureRecord> records;

    template <class T, class Make>
    const T& derive(const Derived<T>& slot, Structure structure, Make&& make)
    {
        return slot.get([&] {
            Stopwatch watch;
            T value = make();
            const std::lock_guard lock(records_mutex);
            records.push_back({structure, watch.lap(), bytes(value)});
            return value;
        });
    }
};

} // namespace detail

using namespace detail;

Scene::Scene(Mesh mesh) : data_(std::make_shared<SceneData>()), mesh_(&data_->mesh)
{
    SceneData& data = *data_;
    data.mesh = std::move(mesh);
    validate(data.mesh);
    Stopwatch watch;
    Numbering numbering = renumber(data.mesh);
    data.caller_cells = std::move(numbering.caller_cells);
    data.caller_points = std::move(numbering.caller_points);
    for (const glm::dvec3& p : data.mesh.points)
        data.bounds.add(p);
    data.tetrahedral = std::all_of(data.mesh.shapes.begin(), data.mesh.shapes.end(),
                                   [](CellShape shape) { return shape == CellShape::tetrahedron; });
    data.records.push_back(
        {Structure::numbering, watch.lap(), size_of(data.caller_cells) + size_of(data.caller_points)});
}

bool Scene::is_tetrahedral() const
{
    return data_->tetrahedral;
}

const Box& Scene::bounds() const
{
    return data_->bounds;
}

std::span<const CellId> Scene::caller_cells() const
{
    return data_->caller_cells;
}

std::span<const PointId> Scene::caller_points() const
{
    return data_->caller_points;
}

const Adjacency& Scene::adjacency() const
{
    if (!is_surface())
        orientations();
    return data_->derive(data_->adjacency, Structure::adjacency, [&] { return derive_adjacency(*this); });
}

const Orientations& Scene::orientations() const
{
    return data_->derive(data_->orientations, Structure::orientations, [&] { return derive_orientations(*this); });
}

const Boundary& Scene::boundary() const
{
    adjacency();
    return data_->derive(data_->boundary, Structure::boundary, [&] { return derive_boundary(*this); });
}

const FacePlanes& Scene::face_planes() const
{
    adjacency();
    return data_->derive(data_->face_planes, Structure::face_planes, [&] { return derive_face_planes(*this); });
}

const LargeArray<glm::vec3>& Scene::centroids() const
{
    return data_->derive(data_->centroids, Structure::centroids, [&] { return derive_centroids(*this); });
}

const Circumspheres& Scene::circumspheres() const
{
    return data_->derive(data_->circumspheres, Structure::circumspheres, [&] { return derive_circumspheres(*this); });
}

const Traits& Scene::traits() const
{
    // Derived first, so that the time of each is its own.
    orientations();
    boundary();
    return data_->derive(data_->traits, Structure::traits, [&] { return derive_traits(*this); });
}

const std::vector<std::pair<CellId, CellId>>& Scene::overlapping_cells() const
{
    boundary();
    return data_->derive(data_->overlapping_cells, Structure::overlapping_cells,
                         [&] { return derive_overlapping_cells(*this); });
}

const std::vector<OverlapPlane>& Scene::overlap_planes() const
{
    overlapping_cells();
    return data_->derive(data_->overlap_planes, Structure::overlap_planes,
                         [&] { return derive_overlap_planes(*this); });
}

const std::vector<CellFace>& Scene::relation_faces() const
{
    overlapping_cells();
    return data_->derive(data_->relation_faces, Structure::relation_faces,
                         [&] { return derive_relation_faces(*this); });
}

std::vector<StructureRecord> Scene::derived() const
{
    const std::lock_guard lock(data_->records_mutex);
    return data_->records;
}

double Scene::diameter() const
{
    const double diagonal = glm::length(bounds().max - bounds().min);
    return diagonal > 0 ? diagonal : 1;
}

} // namespace visorder
