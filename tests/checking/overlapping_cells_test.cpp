#include "brute_force.h"
#include "scene/orientations.h"
#include "scene/overlapping_cells.h"
#include "small_scenes.h"

#include <array>
#include <gtest/gtest.h>
#include <string>

namespace visorder::tests {

using namespace detail;
namespace {

using Pairs = std::vector<std::pair<CellId, CellId>>;

Pairs pairs_by_brute_force(const Scene& scene)
{
    Pairs pairs;
    for (CellId a = 0; a < scene.cell_count(); ++a)
        for (CellId b = a + 1; b < scene.cell_count(); ++b)
            if (scene.orientations().sign[a] != 0 && scene.orientations().sign[b] != 0 &&
                brute_force::interiors_overlap(scene, a, b))
                pairs.emplace_back(a, b);
    return pairs;
}

// By value, so that a mesh can be appended to itself.
void append(Mesh& mesh, Mesh more, const glm::dvec3& scale, const glm::dvec3& shift)
{
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const glm::dvec3& p : more.points)
        mesh.points.push_back(p * scale + shift);
    for (CellId i = 0; i < more.cell_count(); ++i) {
        std::vector<std::uint32_t> v;
        for (std::uint32_t k : more.cell(i))
            v.push_back(k + first);
        mesh.add(more.shapes[i], v);
    }
}

TEST(InteriorsOverlap, AgreesWithTheDefinitionOnRandomCells)
{
    Random random(3);
    int overlapping = 0, apart = 0;
    for (int i = 0; i < 1500; ++i) {
        Mesh mesh;
        const int size = random.from_to(1, 5); // small ones share vertices, edges, faces and planes
        add_random_cell(mesh, random, 0, size);
        add_random_cell(mesh, random, 0, size);
        const Scene scene(mesh);
        const bool expected = brute_force::interiors_overlap(scene, 0, 1);
        ASSERT_EQ(interiors_overlap(scene, 0, 1), expected) << i;
        ASSERT_EQ(interiors_overlap(scene, 1, 0), expected) << i;
        ++(expected ? overlapping : apart);
    }
    EXPECT_GT(overlapping, 300);
    EXPECT_GT(apart, 300);
}

TEST(InteriorsOverlap, OneUlpDecides)
{
    for (const double gap : {0.0, 0x1p-52}) {
        Mesh mesh = whole_boxes({1, 1, 1}, 1, 0, 1);
        append(mesh, mesh, glm::dvec3(1), glm::dvec3(1 - gap, 0.25, 0.3));
        const Scene scene(mesh);
        for (CellId a = 0; a < scene.cell_count(); ++a)
            for (CellId b = 0; b < a; ++b)
                EXPECT_EQ(interiors_overlap(scene, a, b), brute_force::interiors_overlap(scene, a, b));
    }
}

TEST(InteriorsOverlap, FlatCellsHaveNoInterior)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}, {1, 1, 3}, {1, 1, -3}};
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 2, 3});
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{4, 5, 1, 2});
    const Scene scene(mesh);
    EXPECT_FALSE(interiors_overlap(scene, 0, 1));
    EXPECT_TRUE(scene.overlapping_cells().empty());
}

TEST(OverlappingCells, SoundScenesHaveNone)
{
    for (const SmallScene& small : small_scenes())
        EXPECT_TRUE(Scene(small.mesh).overlapping_cells().empty()) << small.name;
}

TEST(OverlappingCells, RandomCellsOverlapAsTheDefinitionHasIt)
{
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        Random random(seed);
        Mesh mesh;
        for (int i = 0; i < 12; ++i)
            add_random_cell(mesh, random, 0, 6);
        const Scene scene(mesh);
        EXPECT_EQ(scene.overlapping_cells(), pairs_by_brute_force(scene)) << seed;
    }
}

TEST(OverlappingCells, AMeshWithinAnotherOverlapsItThoughTheirBoundariesDoNotMeet)
{
    // One box in the middle cell of 3 x 3 x 3, which owns no boundary face.
    Mesh mesh = whole_boxes({3, 3, 3}, 4, 0, 5);
    append(mesh, whole_boxes({1, 1, 1}, 1, 0, 1), glm::dvec3(1), glm::dvec3(5, 5.5, 5));
    const Scene scene(mesh);
    const Pairs expected = pairs_by_brute_force(scene);
    EXPECT_EQ(expected.size(), 1u);
    EXPECT_EQ(scene.overlapping_cells(), expected);
}

TEST(OverlappingCells, AMeshOnTopOfItselfOverlaps)
{
    Mesh mesh = carved_delaunay(8, 20, 1, 2);
    append(mesh, mesh, glm::dvec3(1), glm::dvec3(0));
    const Scene scene(mesh);
    const Pairs pairs = scene.overlapping_cells();
    EXPECT_GE(pairs.size(), scene.cell_count() / 2);
    EXPECT_EQ(pairs, pairs_by_brute_force(scene));
}

TEST(OverlappingCells, FoldedFacesAreFound)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 4}, {2, 2, 5}, {0, 0, -3}};
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 2, 3});
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 2, 4});
    const Scene scene(mesh);
    EXPECT_EQ(scene.overlapping_cells(), (Pairs{{0, 1}}));
}

TEST(OverlappingCells, AFoldBehindAFlatCellIsFound)
{
    // A flat cell between two solids on one side of it.
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 2, 4}, {2, 1, 3}};
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 2, 3});
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 2, 4});
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 3, 5});
    const Scene scene(mesh);
    EXPECT_EQ(scene.overlapping_cells(), pairs_by_brute_force(scene));
    EXPECT_EQ(scene.overlapping_cells().size(), 1u);
}

TEST(OverlappingCells, TrianglesHaveNoInteriors)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {2, 1, 1}};
    mesh.add(CellShape::triangle, std::array<PointId, 3>{0, 1, 2});
    mesh.add(CellShape::triangle, std::array<PointId, 3>{3, 4, 5});
    EXPECT_TRUE(Scene(mesh).overlapping_cells().empty());
}

} // namespace
} // namespace visorder::tests
