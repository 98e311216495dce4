#include "files/convex_hull.h"
#include "files/file_grid.h"
#include "scene/boundary.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <numeric>
#include <random>

using namespace visorder;
using namespace visorder::detail;
using testing::ElementsAre;
using testing::SizeIs;

namespace {

using Faces = std::vector<std::vector<std::int64_t>>;

void add_polyhedron(FileGrid& grid, const Faces& faces)
{
    std::vector<std::int64_t> listed{static_cast<std::int64_t>(faces.size())};
    for (const auto& face : faces) {
        listed.push_back(static_cast<std::int64_t>(face.size()));
        listed.insert(listed.end(), face.begin(), face.end());
    }
    grid.add({ListedShape::polyhedron}, listed);
}

std::string error_of(FileGrid grid)
{
    try {
        mesh_of(std::move(grid), {});
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

double volume_of(const Mesh& mesh)
{
    double sum = 0;
    for (CellId i = 0; i < mesh.cell_count(); ++i) {
        const auto cell = mesh.cell(i);
        sum += sixfold_volume({cell[0], cell[1], cell[2], cell[3]}, mesh.points) / 6;
    }
    return sum;
}

/// The unit cube's corners, and its faces counterclockwise from outside.
const std::vector<glm::dvec3> cube_points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                          {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const Faces cube{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

/// An L as high as 1: a square of side 2 without that of side 1 at its corner (2, 2). Its inner corner is point
/// `first + 3`.
FileGrid ell(int turn)
{
    const std::array<std::array<double, 2>, 6> outline{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
    FileGrid grid;
    grid.path = "ell";
    Faces faces(2);
    for (int level = 0; level < 2; ++level)
        for (int i = 0; i < 6; ++i) {
            const auto& p = outline[static_cast<std::size_t>((i + turn) % 6)];
            grid.points.emplace_back(p[0], p[1], level);
        }
    for (int i = 0; i < 6; ++i) {
        faces[0].insert(faces[0].begin(), i);
        faces[1].push_back(i + 6);
        faces.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
    }
    add_polyhedron(grid, faces);
    return grid;
}

} // namespace

TEST(Polyhedron, IsCutWhicheverWayItsFacesTurn)
{
    for (unsigned turned = 0; turned < 64; ++turned) {
        FileGrid grid;
        grid.points = cube_points;
        Faces faces = cube;
        for (std::size_t i = 0; i < faces.size(); ++i)
            if ((turned >> i & 1) != 0)
                std::reverse(faces[i].begin(), faces[i].end());
        add_polyhedron(grid, faces);
        const MeshFile file = mesh_of(std::move(grid), {});
        EXPECT_DOUBLE_EQ(volume_of(file.mesh), 1);
        const Scene scene(file.mesh);
        EXPECT_EQ(scene.traits().inverted_cells, 0u);
        EXPECT_EQ(scene.boundary().faces.size(), 12u);
        EXPECT_EQ(*std::max_element(file.file_cells.begin(), file.file_cells.end()), 0u);
    }
}

TEST(Polyhedron, SharesTrianglesWithItsNeighboursHoweverPointsAreNumbered)
{
    // Two cubes side by side, one a polyhedron, the other a polyhedron or a hexahedron.
    std::mt19937 random(1);
    for (int run = 0; run < 200; ++run) {
        std::array<std::int64_t, 12> number{};
        std::iota(number.begin(), number.end(), 0);
        std::shuffle(number.begin(), number.end(), random);
        FileGrid grid;
        grid.points.resize(12);
        std::vector<std::vector<std::int64_t>> corners(2);
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 p = cube_points[static_cast<std::size_t>(i)];
            for (int side = 0; side < 2; ++side) {
                const int place = static_cast<int>(p.x) + side + 3 * static_cast<int>(p.y) + 6 * static_cast<int>(p.z);
                const std::int64_t id = number[static_cast<std::size_t>(place)];
                grid.points[static_cast<std::size_t>(id)] = p + glm::dvec3(side, 0, 0);
                corners[static_cast<std::size_t>(side)].push_back(id);
            }
        }
        for (int side = 0; side < 2; ++side) {
            const auto& own = corners[static_cast<std::size_t>(side)];
            if (side == 1 && run % 2 == 1) {
                grid.add({ListedShape::hexahedron}, own);
                continue;
            }
            Faces faces = cube;
            for (auto& face : faces)
                for (std::int64_t& corner : face)
                    corner = own[static_cast<std::size_t>(corner)];
            add_polyhedron(grid, faces);
        }
        const Scene scene(subdivide(mesh_of(std::move(grid), {}).mesh).mesh);
        EXPECT_EQ(scene.boundary().faces.size(), 20u) << "run " << run;
        EXPECT_TRUE(scene.traits().face_to_face) << "run " << run;
    }
}

TEST(Polyhedron, WithADentIsCutOnlyIfItIsSeenWholeFromItsFirstPoint)
{
    for (int turn = 0; turn < 6; ++turn) {
        const std::string error = error_of(ell(turn));
        if (turn == 0 || turn == 3) // the first point is the outer corner opposite to the dent, or the dent's own
            EXPECT_EQ(error, "") << turn;
        else
            EXPECT_EQ(error, "ell: cell 0: a polyhedron that is not convex") << turn;
    }
    EXPECT_DOUBLE_EQ(volume_of(mesh_of(ell(3), {}).mesh), 3);
}

TEST(Polyhedron, IsRefusedIfItsFacesDoNotClose)
{
    FileGrid grid;
    grid.path = "cube";
    grid.points = cube_points;
    FileGrid without_a_face = grid, face_twice = grid, short_list = grid, beyond = grid;
    add_polyhedron(without_a_face, {cube.begin(), cube.end() - 1});
    EXPECT_EQ(error_of(without_a_face), "cube: cell 0: a polyhedron whose faces do not close");
    Faces twice = cube;
    twice.push_back(cube.front());
    add_polyhedron(face_twice, twice);
    EXPECT_EQ(error_of(face_twice), "cube: cell 0: a polyhedron whose faces do not close");
    short_list.add({ListedShape::polyhedron}, std::array<std::int64_t, 4>{6, 3, 0, 1});
    EXPECT_EQ(error_of(short_list), "cube: cell 0: a polyhedron whose faces are cut short");
    add_polyhedron(beyond, {{0, 1, 8}});
    EXPECT_EQ(error_of(beyond), "cube: cell 0: there is no point 8");
}

TEST(ConvexHull, HasTheFacesOfItsPointsOnALattice)
{
    // Of all points of a lattice the corners are the cube's, whatever lies in edges, faces and the inside.
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 64; ++i)
        points.emplace_back(i % 4, i / 4 % 4, i / 16);
    std::vector<PointId> some(64);
    std::iota(some.begin(), some.end(), 0u);
    std::mt19937 random(2);
    for (int run = 0; run < 5; ++run) {
        std::shuffle(some.begin(), some.end(), random);
        PolyhedronFaces faces = convex_hull(some, points);
        ASSERT_EQ(faces.count(), 6u);
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_THAT(faces.face(i), SizeIs(4));
        const std::vector<PointId> before = faces.corners;
        EXPECT_TRUE(orient_faces(faces));
        EXPECT_EQ(faces.corners, before); // all turned alike already
        std::vector<TetrahedronCorners> parts;
        cut_into_tetrahedra(faces, parts);
        double volume = 0;
        for (const auto& part : parts) {
            EXPECT_GT(sixfold_volume(part, points), 0);
            volume += sixfold_volume(part, points) / 6;
        }
        EXPECT_DOUBLE_EQ(volume, 27);
    }
}

TEST(ConvexHull, HoldsAllPointsOfACloud)
{
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int run = 0; run < 20; ++run) {
        std::vector<glm::dvec3> points;
        for (int i = 0; i < 30; ++i)
            points.emplace_back(normal(random), normal(random), normal(random));
        std::vector<PointId> all(points.size());
        std::iota(all.begin(), all.end(), 0u);
        PolyhedronFaces faces = convex_hull(all, points);
        EXPECT_TRUE(orient_faces(faces)); // closed
        for (std::size_t i = 0; i < faces.count(); ++i)
            for (const PointId other : all) // outside of no face
                EXPECT_LE(sixfold_volume({faces.face(i)[0], faces.face(i)[1], faces.face(i)[2], other}, points), 1e-12);
    }
}

TEST(ConvexHull, HasNoFacesInAPlane)
{
    const std::vector<glm::dvec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 0}};
    EXPECT_EQ(convex_hull(std::array<PointId, 5>{0, 1, 2, 3, 4}, points).count(), 0u);
    EXPECT_EQ(convex_hull(std::array<PointId, 2>{0, 1}, points).count(), 0u);
}
