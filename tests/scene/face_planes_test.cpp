#include "scene/face_planes.h"

#include "geometry/exact_predicates.h"
#include "meshes.h"
#include "scene/adjacency.h"
#include "scene/face_loop.h"
#include "scene/orientations.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <random>

namespace visorder::tests {

using namespace detail;
namespace {

// The side of a face as its cell's vertices and the exact predicate have it, for solid cells.
Sign reference_side(const Scene& scene, CellId cell, int face, const glm::dvec4& eye)
{
    const Mesh& mesh = scene.mesh();
    const FaceLoop loop = face_loop(mesh, cell, face);
    const Sign side = side_of_plane_exact(mesh.points[loop.vertices[0]], mesh.points[loop.vertices[1]],
                                          mesh.points[loop.vertices[2]], eye);
    return scene.orientations().sign[cell] < 0 ? -side : side;
}

void expect_signs(const Scene& scene, const glm::dvec4& eye)
{
    FaceSigns signs;
    signs.evaluate(scene, eye);
    for (CellId cell = 0; cell < scene.cell_count(); ++cell)
        for (int face = 0; face < face_count(scene.mesh().shapes[cell]); ++face) {
            const Sign expected = reference_side(scene, cell, face, eye);
            const bool entry = (signs.entry(cell) >> face & 1) != 0, exit = (signs.exit(cell) >> face & 1) != 0;
            ASSERT_EQ(entry, expected == Sign::positive)
                << "cell " << scene.caller_cells()[cell] << " face " << face << " eye " << eye.x << "," << eye.y << ","
                << eye.z << "," << eye.w;
            ASSERT_EQ(exit, expected == Sign::negative)
                << "cell " << scene.caller_cells()[cell] << " face " << face << " eye " << eye.x << "," << eye.y << ","
                << eye.z << "," << eye.w;
        }
}

std::vector<glm::dvec4> eyes_for(const Scene& scene)
{
    const glm::dvec3 middle = scene.bounds().middle();
    const double size = glm::length(scene.bounds().max - scene.bounds().min);
    std::mt19937_64 random(3);
    const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
    std::vector<glm::dvec4> eyes{{1, 0, 0, 0}, {0, 0, -1, 0}, {1, 1, 0, 0}, {1, -1, 1, 0}, {1e-300, 0, 1e-300, 0}};
    for (std::size_t i = 0; i < scene.mesh().points.size(); i += 1 + scene.mesh().points.size() / 8)
        eyes.emplace_back(scene.mesh().points[i], 1);
    for (double distance : {0.0, 1e-12, 0.1, 1.0, 3.0, 1e3, 1e9, 1e200})
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 p = middle + distance * size * glm::dvec3(number(), number(), number());
            eyes.emplace_back(p, 1);
            eyes.emplace_back(-2.5 * p, -2.5);
        }
    return eyes;
}

Mesh moved(Mesh mesh, const glm::dvec3& by, double scale)
{
    for (glm::dvec3& p : mesh.points)
        p = p * scale + by;
    return mesh;
}

TEST(FaceSigns, AgreeWithExactArithmeticOnEveryFaceFromEveryEye)
{
    std::mt19937_64 random(5);
    Mesh jittered = subdivide(cubes(4)).mesh;
    for (glm::dvec3& p : jittered.points)
        for (int k = 0; k < 3; ++k)
            p[k] += static_cast<double>(random() >> 11) * 0x1p-53 * 1e-9;
    for (const Mesh& mesh : {cubes(3), zoo(), jittered, moved(jittered, {1e6, -3e6, 2e6}, 1),
                             moved(jittered, {0, 0, 0}, 1e-200), moved(jittered, {0, 0, 0}, 1e150)}) {
        const Scene scene(mesh);
        for (const glm::dvec4& eye : eyes_for(scene))
            ASSERT_NO_FATAL_FAILURE(expect_signs(scene, eye));
    }
}

TEST(FaceSigns, TurnTheFacesOfInvertedCells)
{
    Mesh inverted;
    inverted.points = two_tetrahedra().points;
    add_tetrahedron(inverted, 0, 2, 1, 3);
    add_tetrahedron(inverted, 1, 2, 3, 4);
    const Scene scene(inverted);
    EXPECT_EQ(scene.traits().inverted_cells, 1u);
    EXPECT_EQ(scene.traits().folded_faces, 0u);
    for (const glm::dvec4& eye : eyes_for(scene))
        ASSERT_NO_FATAL_FAILURE(expect_signs(scene, eye));
}

// A flat cell between two solid ones: a square in the plane z = 0 as a tetrahedron, with two tetrahedra on either side.
Mesh flat_between_solids(bool turned)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}};
    if (turned)
        add_tetrahedron(mesh, 0, 2, 1, 3);
    else
        add_tetrahedron(mesh, 0, 1, 2, 3);
    add_tetrahedron(mesh, 0, 2, 1, 4); // below, on diagonal 0-2
    add_tetrahedron(mesh, 0, 3, 2, 4);
    add_tetrahedron(mesh, 0, 1, 3, 5); // above, on diagonal 1-3
    add_tetrahedron(mesh, 1, 2, 3, 5);
    return mesh;
}

TEST(FaceSigns, LetRelationsRunThroughFlatCells)
{
    for (bool turned : {false, true}) {
        const Scene scene(flat_between_solids(turned));
        EXPECT_EQ(scene.traits().flat_cells, 1u);
        EXPECT_EQ(scene.traits().folded_faces, 0u);
        FaceSigns signs;
        signs.evaluate(scene, {0.3, 0.4, 5, 1});
        for (CellId cell = 0; cell < scene.cell_count(); ++cell) {
            if (scene.caller_cells()[cell] != 0)
                continue;
            // Seen from above, the two cells above are entered before the flat one, the two below after it.
            for (int face = 0; face < 4; ++face) {
                const CellId across = scene.caller_cells()[scene.adjacency().row(cell)[static_cast<std::size_t>(face)]];
                const bool above = across >= 3;
                EXPECT_EQ((signs.entry(cell) >> face & 1) != 0, above) << turned << " " << face;
                EXPECT_EQ((signs.exit(cell) >> face & 1) != 0, !above) << turned << " " << face;
            }
        }
    }
}

TEST(FaceSigns, GiveNoRelationAcrossAFold)
{
    Mesh mesh = two_tetrahedra();
    mesh.points[4] = {0.1, 0.1, 0.1}; // now on the same side as point 0
    const Scene scene(mesh);
    EXPECT_EQ(scene.traits().folded_faces, 1u);
    FaceSigns signs;
    signs.evaluate(scene, {3, 3, 3, 1});
    for (CellId cell = 0; cell < 2; ++cell)
        EXPECT_EQ((signs.entry(cell) | signs.exit(cell)) & scene.adjacency().interior[cell], 0u);
}

TEST(FacePlanes, RefuseFacesThatAreNotPlanar)
{
    Mesh mesh = cubes(2);
    mesh.points[13] += glm::dvec3(1e-13, 0, 0);
    const Scene scene(mesh);
    EXPECT_FALSE(scene.traits().planar_faces);
    EXPECT_THROW(scene.face_planes(), InputError);
    EXPECT_TRUE(Scene(cubes(2)).traits().planar_faces);
}

} // namespace
} // namespace visorder::tests
