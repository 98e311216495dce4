#include "files/point_joining.h"

#include "files/file_grid.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

using namespace visorder;
using namespace visorder::detail;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(PointJoining, JoinsEqualPointsOfDifferentPieces)
{
    const std::vector<glm::dvec3> points{{1, 0, 0}, {0, 0, 0}, {2, 0, 0}, {-0.0, 0, 0}, {1, 0, 0}};
    const JoinedPoints joined = join_pieces(points, std::array<std::size_t, 2>{0, 2});
    EXPECT_THAT(joined.number, ElementsAre(0, 1, 2, 1, 0));
    EXPECT_THAT(joined.kept, ElementsAre(0, 1, 2));
}

TEST(PointJoining, KeepsEqualPointsOfOnePieceApart)
{
    const glm::dvec3 p(0), q(1);
    EXPECT_THAT(join_pieces(std::vector{p, p, q}, {}).number, ElementsAre(0, 1, 2));
    // The pieces' first ones join, their second ones, and the third of the last stays alone.
    EXPECT_THAT(join_pieces(std::vector{p, p, q, p, p, p}, std::array<std::size_t, 3>{0, 2, 2}).number,
                ElementsAre(0, 1, 2, 0, 1, 3));
}

TEST(PointJoining, JoinsNoPointsThatAreNotNumbers)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<glm::dvec3> points{{nan, 0, 0}, {nan, 0, 0}, {nan, 0, 0}};
    EXPECT_THAT(join_all(points).number, ElementsAre(0, 1, 2));
    EXPECT_THAT(join_pieces(points, std::array<std::size_t, 2>{0, 1}).number, ElementsAre(0, 1, 2));
}

TEST(PointJoining, AGridOfPiecesMeetsFaceToFace)
{
    // Two tetrahedra that have their points in pieces of their own, and data on one piece's points alone.
    FileGrid grid;
    grid.points = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {-1, 0, 0}};
    grid.pieces = {0, 4};
    grid.blocks = {{"left", 0}, {"right", 1}};
    grid.add({ListedShape::tetrahedron}, std::array<std::int64_t, 4>{0, 1, 2, 3});
    grid.add({ListedShape::tetrahedron}, std::array<std::int64_t, 4>{4, 5, 6, 7});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    grid.arrays = {{"T", false, 1, false, [=] { return std::vector<double>{nan, nan, nan, nan, 4, 5, 6, 7}; }}};
    const MeshFile file = mesh_of(std::move(grid), {});
    EXPECT_THAT(file.mesh.vertices, ElementsAre(0, 1, 2, 3, 1, 0, 2, 4));
    EXPECT_THAT(file.notes, ElementsAre("3 points joined with those of other pieces at the same coordinates"));
    EXPECT_EQ(file.mesh.scalars[0], 5);
    EXPECT_EQ(file.mesh.scalars[1], 4);
    EXPECT_TRUE(std::isnan(file.mesh.scalars[3]));
    EXPECT_EQ(file.mesh.scalars[4], 7);
}
