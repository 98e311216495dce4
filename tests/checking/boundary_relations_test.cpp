#include "geometry/exact_predicates.h"
#include "geometry/face_overlap.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "scene/face_planes.h"
#include "small_scenes.h"
#include "sorting/boundary_relations.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <set>

namespace visorder::tests {

using namespace detail;
namespace {

// All pairs, without an index.
BoundaryRelations all_pairs(const Scene& scene, const glm::dvec4& eye)
{
    std::vector<CellFace> exits, entries;
    if (scene.is_surface()) {
        for (CellId cell = 0; cell < scene.cell_count(); ++cell)
            exits.push_back({cell, 0});
        entries = exits;
    } else {
        for (const CellFace& face : scene.boundary().faces) {
            const Sign side = exact_face_side(scene, face.cell, static_cast<int>(face.face), eye);
            if (side != Sign::zero)
                (side == Sign::negative ? exits : entries).push_back(face);
        }
    }
    std::set<Relation> relations;
    const auto& in_space = scene.overlapping_cells();
    std::set<std::pair<CellId, CellId>> overlapping(in_space.begin(), in_space.end());
    for (const CellFace& f : exits)
        for (const CellFace& g : entries) {
            if (f.cell == g.cell)
                continue;
            if (!scene.is_surface()) {
                const auto row = scene.adjacency().row(f.cell);
                if (std::find(row.begin(), row.end(), g.cell) != row.end())
                    continue;
            }
            const Overlap overlap = face_overlap(points_of(scene, f), points_of(scene, g), eye);
            if (overlap == Overlap::nearer || (overlap == Overlap::coincident && !scene.is_surface()))
                relations.insert({f.cell, g.cell});
            if (overlap == Overlap::crossing)
                overlapping.insert(std::minmax(f.cell, g.cell));
        }
    std::erase_if(relations, [&](const Relation& relation) {
        return overlapping.contains(std::minmax(relation.front, relation.back));
    });
    return {{relations.begin(), relations.end()}, {overlapping.begin(), overlapping.end()}};
}

// Far, near, in the middle, on lines and in planes of the scene, with other weights and along directions.
std::vector<glm::dvec4> eyes_around(const Scene& scene)
{
    const glm::dvec3 middle = scene.bounds().middle(), size = scene.bounds().max - scene.bounds().min;
    const glm::dvec3 vertex = scene.mesh().points[scene.mesh().points.size() / 2];
    std::vector<glm::dvec4> eyes = small_scene_eyes(scene, 5);
    for (const double away : {0.01, 0.6, 1.0, 7.0, 1e3, 1e9})
        for (const glm::dvec3& direction : {glm::dvec3(0.3, 0.5, 0.8), glm::dvec3(-1, 0.1, 0.2), glm::dvec3(0, 0, -1)})
            eyes.emplace_back(middle + away * direction * size, 1);
    for (const double away : {1e-12, 1e-6})
        eyes.emplace_back(vertex + glm::dvec3(0.6, -0.3, 0.7) * away * size, 1);
    eyes.emplace_back((middle + size) * 3.0, 3);
    eyes.emplace_back(middle * 0.1, 0.1);
    eyes.emplace_back((middle - 2.0 * size) * -1.7, -1.7);
    eyes.emplace_back(middle * -1.0, -1);
    eyes.emplace_back(1e-200, 2e-200, -1e-200, 0);
    eyes.emplace_back(1e200, 3e200, 2e200, 0);
    eyes.emplace_back(1e150, 3e150, 2e150, 1);
    eyes.emplace_back(1e305, 3e305, 2e305, 1);
    eyes.emplace_back(1, 1e-9, 0, 0);
    return eyes;
}

void expect_all_pairs(const Mesh& mesh, const std::string& name)
{
    const Scene scene(mesh);
    BoundaryRelations found;
    for (const glm::dvec4& eye : eyes_around(scene)) {
        const BoundaryRelations expected = all_pairs(scene, eye);
        boundary_relations(scene, eye, found);
        EXPECT_EQ(found.relations, expected.relations)
            << name << " from " << eye.x << ", " << eye.y << ", " << eye.z << ", " << eye.w;
        EXPECT_EQ(found.overlapping, expected.overlapping);
    }
}

// Moves a mesh to a place where its coordinates are no longer integers, and rounds.
Mesh moved(Mesh mesh, double scale, const glm::dvec3& shift)
{
    for (glm::dvec3& p : mesh.points)
        p = p * scale + shift;
    return mesh;
}

TEST(BoundaryRelations, TheIndexLosesNoPairOfSmallScenes)
{
    for (const SmallScene& small : small_scenes())
        expect_all_pairs(small.mesh, small.name);
}

TEST(BoundaryRelations, TheIndexLosesNoPairOfManyFaces)
{
    expect_all_pairs(box_grid({4, 4, 4}, 2, 0.5, 3), "boxes");
    expect_all_pairs(scattered_cells(150, 20, 3), "scattered cells");
}

TEST(BoundaryRelations, TheIndexLosesNoPairWhereCoordinatesAreLargeOrSmall)
{
    const Mesh delaunay = carved_delaunay(10, 60, 0.5, 21);
    expect_all_pairs(moved(delaunay, 0.1, {1e7, -2e7, 3e7}), "far from the origin");
    expect_all_pairs(moved(delaunay, 1e-200, glm::dvec3(0)), "tiny");
    expect_all_pairs(moved(delaunay, 1e200, glm::dvec3(0)), "huge");
    expect_all_pairs(moved(delaunay, 2e306, glm::dvec3(-6e307)), "as large as doubles allow");
}

TEST(BoundaryRelations, LeaveOutCellsThatOverlap)
{
    Random random(4);
    Mesh mesh;
    for (int i = 0; i < 12; ++i)
        add_random_cell(mesh, random, 0, 9);
    expect_all_pairs(mesh, "overlapping cells");
}

TEST(BoundaryRelations, TrianglesOfASurfaceCoverEachOther)
{
    Random random(9);
    Mesh mesh;
    for (PointId i = 0; i < 40; ++i) {
        for (int k = 0; k < 3; ++k)
            mesh.points.push_back(random.integer_point(0, 8));
        mesh.add(CellShape::triangle, std::array<PointId, 3>{3 * i, 3 * i + 1, 3 * i + 2});
    }
    expect_all_pairs(mesh, "triangles");
}

TEST(BoundaryRelations, DoNotDependOnThreads)
{
    const Scene scene(box_grid({6, 6, 6}, 2, 0.5, 8));
    for (const glm::dvec4& eye : {glm::dvec4(30, 20, 50, 1), glm::dvec4(6.5, 5.5, 4.5, 1), glm::dvec4(1, 2, 3, 0)}) {
        BoundaryRelations one, many;
        {
            const oneapi::tbb::global_control single(oneapi::tbb::global_control::max_allowed_parallelism, 1);
            boundary_relations(scene, eye, one);
        }
        boundary_relations(scene, eye, many);
        EXPECT_EQ(one.relations, many.relations);
        EXPECT_EQ(one.overlapping, many.overlapping);
        EXPECT_EQ(one.candidates, many.candidates);
        EXPECT_GT(one.relations.size(), 100u);
    }
}

} // namespace
} // namespace visorder::tests
