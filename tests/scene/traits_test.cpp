#include "scene/traits.h"

#include "meshes.h"
#include "parallel/large_array.h"
#include "scene/boundary.h"
#include "scene/circumspheres.h"
#include "scene/face_planes.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <thread>

namespace visorder::tests {

using namespace detail;
namespace {

Mesh joined(const Mesh& a, const Mesh& b, const glm::dvec3& by)
{
    Mesh mesh = a;
    const auto shift = static_cast<std::uint32_t>(a.points.size());
    for (const glm::dvec3& p : b.points)
        mesh.points.push_back(p + by);
    for (CellId cell = 0; cell < b.cell_count(); ++cell) {
        std::vector<std::uint32_t> v(b.cell(cell).begin(), b.cell(cell).end());
        for (std::uint32_t& i : v)
            i += shift;
        mesh.add(b.shapes[cell], v);
    }
    return mesh;
}

TEST(Traits, KnowConvexFromConcave)
{
    EXPECT_TRUE(Scene(cubes(3)).traits().convex);
    EXPECT_TRUE(Scene(subdivide(cubes(3)).mesh).traits().convex);
    EXPECT_TRUE(Scene(cubes(1)).traits().convex);
    EXPECT_FALSE(Scene(cubes(3, [](int x, int y, int z) { return x + y + z > 0; })).traits().convex) << "a corner off";
    EXPECT_FALSE(Scene(cubes(3, [](int x, int y, int z) { return x != 1 || y != 1 || z != 1; })).traits().convex)
        << "hollow";
    EXPECT_FALSE(Scene(joined(cubes(1), cubes(1), {2, 0, 0})).traits().convex) << "two bodies";
}

TEST(Traits, TakeASlitForConcave)
{
    // Two slabs of boxes that touch along half of their common side without sharing its faces.
    Mesh mesh = cubes(2);
    const auto copy = static_cast<std::uint32_t>(mesh.points.size());
    // The middle of the side x = 1 of the boxes at y = 1: points (1, 2, z), which the left boxes keep to themselves.
    std::vector<std::uint32_t> of_slit;
    for (std::uint32_t i = 0; i < copy; ++i)
        if (mesh.points[i].x == 1 && mesh.points[i].y == 2) {
            of_slit.push_back(i);
            mesh.points.push_back(mesh.points[i]);
        }
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell) {
        bool left = true;
        for (std::uint32_t k = mesh.offsets[cell]; k < mesh.offsets[cell + 1]; ++k)
            left = left && mesh.points[mesh.vertices[k]].x <= 1;
        for (std::uint32_t k = mesh.offsets[cell]; left && k < mesh.offsets[cell + 1]; ++k)
            for (std::size_t s = 0; s < of_slit.size(); ++s)
                if (mesh.vertices[k] == of_slit[s])
                    mesh.vertices[k] = copy + static_cast<std::uint32_t>(s);
    }
    const Scene scene(mesh);
    EXPECT_EQ(scene.boundary().faces.size(), 24u + 4u);
    EXPECT_FALSE(scene.traits().convex);
    EXPECT_FALSE(scene.traits().face_to_face) << "the sides of the slit touch";
}

TEST(Traits, KnowContactFromFaceToFace)
{
    EXPECT_TRUE(Scene(cubes(2)).traits().face_to_face);
    EXPECT_FALSE(Scene(joined(cubes(1), cubes(1), {1, 0.5, 0})).traits().face_to_face) << "sides that share area";
    EXPECT_TRUE(Scene(joined(cubes(1), cubes(1), {1, 1, 0})).traits().face_to_face) << "edges that touch";
    EXPECT_TRUE(Scene(joined(cubes(1), cubes(1), {3, 0, 0})).traits().face_to_face) << "apart in one plane";
}

TEST(Traits, KnowDelaunay)
{
    EXPECT_TRUE(Scene(subdivide(cubes(2)).mesh).traits().delaunay) << "with ties";
    Mesh mesh = two_tetrahedra();
    EXPECT_TRUE(Scene(mesh).traits().delaunay);
    mesh.points[4] = {0.5, 0.5, 0.5}; // inside the sphere around the first
    EXPECT_FALSE(Scene(mesh).traits().delaunay);
    mesh.points[4] = {1, 1, 1};
    // Apart, and one inside the sphere of another.
    EXPECT_FALSE(Scene(joined(two_tetrahedra(), two_tetrahedra(), {0.6, 0.6, 0.62})).traits().delaunay);
    EXPECT_TRUE(Scene(joined(two_tetrahedra(), two_tetrahedra(), {5, 0, 0})).traits().delaunay);
}

TEST(Circumspheres, GiveEqualPowersToACellsVertices)
{
    std::vector<Mesh> meshes{subdivide(cubes(2)).mesh, cubes(2), two_tetrahedra()};
    Mesh sliver;
    sliver.points = {{0, 0, 0}, {1, 0, 1e-9}, {1, 1, 0}, {0, 1, 1e-9}};
    add_tetrahedron(sliver, 0, 1, 3, 2);
    meshes.push_back(sliver);
    for (const Mesh& mesh : meshes) {
        const Scene scene(mesh);
        const Circumspheres& spheres = scene.circumspheres();
        EXPECT_EQ(spheres.stand_ins, 0u);
        for (CellId cell = 0; cell < scene.cell_count(); ++cell) {
            const double size = glm::dot(spheres.centre[cell], spheres.centre[cell]) + 1;
            for (PointId v : scene.mesh().cell(cell)) {
                const glm::dvec3 x = scene.mesh().points[v] - spheres.origin;
                const double power = glm::dot(x, x) - 2 * glm::dot(spheres.centre[cell], x) + spheres.constant[cell];
                EXPECT_NEAR(power, 0, 1e-14 * size);
            }
        }
    }
}

TEST(Circumspheres, StandInForFlatCells)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    add_tetrahedron(mesh, 0, 1, 2, 3);
    const Scene scene(mesh);
    EXPECT_EQ(scene.circumspheres().stand_ins, 1u);
    EXPECT_TRUE(std::isfinite(scene.circumspheres().constant[0]));
}

TEST(Scene, DerivesEachStructureOnceAndRecordsIt)
{
    const Scene scene(subdivide(cubes(6)).mesh);
    ASSERT_EQ(scene.derived().size(), 1u) << "only the numbering";
    std::vector<std::thread> threads;
    std::vector<const void*> seen(8);
    for (std::size_t i = 0; i < seen.size(); ++i)
        threads.emplace_back([&, i] {
            seen[i] = &scene.face_planes();
            scene.centroids();
            scene.traits();
        });
    for (std::thread& thread : threads)
        thread.join();
    for (const void* planes : seen)
        EXPECT_EQ(planes, seen[0]);
    std::vector<Structure> derived;
    for (const StructureRecord& record : scene.derived())
        derived.push_back(record.structure);
    std::sort(derived.begin(), derived.end());
    EXPECT_EQ(std::adjacent_find(derived.begin(), derived.end()), derived.end()) << "one of them twice";
}

TEST(Scene, LeadsBackToTheCallersNumbering)
{
    const Mesh mesh = subdivide(cubes(3)).mesh;
    const Scene scene(mesh);
    std::vector<CellId> cells(scene.caller_cells().begin(), scene.caller_cells().end());
    for (CellId inner = 0; inner < scene.cell_count(); ++inner) {
        const auto there = scene.mesh().cell(inner), here = mesh.cell(scene.caller_cells()[inner]);
        ASSERT_EQ(there.size(), here.size());
        for (std::size_t k = 0; k < here.size(); ++k) {
            EXPECT_EQ(scene.caller_points()[there[k]], here[k]);
            EXPECT_EQ(scene.mesh().points[there[k]], mesh.points[here[k]]);
        }
    }
    std::sort(cells.begin(), cells.end());
    for (CellId i = 0; i < cells.size(); ++i)
        EXPECT_EQ(cells[i], i);
}

} // namespace
} // namespace visorder::tests
