#include "vtk/vtk_cell_center.h"

#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <limits>
#include <numeric>

using namespace visorder;
using namespace visorder::detail;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

/// Unit cubes along x, from 0 on; `places[i]` says where cell i stands.
Mesh row_of_cubes(const std::vector<int>& places)
{
    Mesh mesh;
    for (const int place : places) {
        std::vector<PointId> cube(8);
        std::iota(cube.begin(), cube.end(), static_cast<PointId>(mesh.points.size()));
        for (const double z : {0.0, 1.0})
            for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
                mesh.points.emplace_back(place + x, y, z);
        mesh.add(CellShape::hexahedron, cube);
    }
    return mesh;
}

std::vector<CellId> sorted(const Scene& scene, const View& view)
{
    Order order;
    VtkCellCenter(scene).sort(view, order);
    return order.back_to_front;
}

/// A matrix that shows no direction.
View seen_from(const glm::dvec4& eye)
{
    return {eye, glm::dmat4(1), {64, 64}};
}

const Scene& shuffled_row()
{
    static const Scene scene(row_of_cubes({3, 0, 4, 1, 2}));
    return scene;
}

} // namespace

TEST(VtkCellCenter, IsApproximate)
{
    EXPECT_EQ(VtkCellCenter(shuffled_row()).guarantee(), Guarantee::approximate);
}

TEST(VtkCellCenter, SortsInTheCallersNumbering)
{
    EXPECT_THAT(sorted(shuffled_row(), look_at({9, 0.5, 0.5}, {2, 0.5, 0.5}, 3)), ElementsAre(1, 3, 4, 0, 2));
    EXPECT_THAT(sorted(shuffled_row(), look_at({-9, 0.5, 0.5}, {2, 0.5, 0.5}, 3)), ElementsAre(2, 0, 4, 3, 1));
}

TEST(VtkCellCenter, SortsParallelViews)
{
    EXPECT_THAT(sorted(shuffled_row(), parallel({1, 0.1, 0.2}, {2, 0.5, 0.5}, 3)), ElementsAre(1, 3, 4, 0, 2));
    EXPECT_THAT(sorted(shuffled_row(), parallel({-1, 0.1, 0.2}, {2, 0.5, 0.5}, 3)), ElementsAre(2, 0, 4, 3, 1));
}

TEST(VtkCellCenter, SortsAlongTheViewDirectionOfTheMatrix)
{
    // From beside the row the camera looks at one end or the other; from the eye alone there is no telling.
    const glm::dvec3 eye(2.5, 0.5, 9);
    EXPECT_THAT(sorted(shuffled_row(), look_at(eye, {0, 0.5, 0.5}, 3)), ElementsAre(1, 3, 4, 0, 2));
    EXPECT_THAT(sorted(shuffled_row(), look_at(eye, {5, 0.5, 0.5}, 3)), ElementsAre(2, 0, 4, 3, 1));

    // The same with a matrix of another scale.
    View view = look_at(eye, {0, 0.5, 0.5}, 3);
    view.world_to_clip *= 1e-3;
    EXPECT_THAT(sorted(shuffled_row(), view), ElementsAre(1, 3, 4, 0, 2));
}

TEST(VtkCellCenter, LooksToTheMiddleWhereTheMatrixShowsNoDirection)
{
    EXPECT_THAT(sorted(shuffled_row(), seen_from({9, 0, 0, 1})), ElementsAre(1, 3, 4, 0, 2));
    EXPECT_THAT(sorted(shuffled_row(), seen_from({-18, 0, 0, 2})), ElementsAre(2, 0, 4, 3, 1));
    EXPECT_THAT(sorted(shuffled_row(), seen_from({-9, 0, 0, -1})), ElementsAre(1, 3, 4, 0, 2));
    View view = seen_from({9, 0, 0, 1});
    view.world_to_clip = glm::dmat4(std::numeric_limits<double>::quiet_NaN());
    EXPECT_THAT(sorted(shuffled_row(), view), ElementsAre(1, 3, 4, 0, 2));
    view.world_to_clip = glm::dmat4(0);
    EXPECT_THAT(sorted(shuffled_row(), view), ElementsAre(1, 3, 4, 0, 2));
}

TEST(VtkCellCenter, SortsFromEyesNearAndFar)
{
    for (const double distance : {1e-12, 1.0, 1e9, 1e30, 1e60, 1e300})
        EXPECT_THAT(sorted(shuffled_row(), seen_from({5 + distance, 0.5, 0.5, 1})), ElementsAre(1, 3, 4, 0, 2));
    EXPECT_THAT(sorted(shuffled_row(), seen_from({1, 0, 0, 1e-320})), ElementsAre(1, 3, 4, 0, 2));
    EXPECT_THAT(sorted(shuffled_row(), seen_from({1e-200, 0, 0, 0})), ElementsAre(1, 3, 4, 0, 2));
    EXPECT_THAT(sorted(shuffled_row(), seen_from({-1e200, 0, 0, 0})), ElementsAre(2, 0, 4, 3, 1));
}

TEST(VtkCellCenter, ReturnsEveryCellOnceFromTheMiddle)
{
    std::vector<CellId> order = sorted(shuffled_row(), seen_from({2.5, 0.5, 0.5, 1}));
    std::sort(order.begin(), order.end());
    EXPECT_THAT(order, ElementsAre(0, 1, 2, 3, 4));
}

TEST(VtkCellCenter, ReusesASorterFromViewToView)
{
    VtkCellCenter sorter(shuffled_row());
    Order order;
    order.layer_begin = {0, 2};
    order.cycles = {{1, 2}};
    for (int i = 0; i < 3; ++i) {
        sorter.sort(look_at({9, 0.5, 0.5}, {2, 0.5, 0.5}, 3), order);
        EXPECT_THAT(order.back_to_front, ElementsAre(1, 3, 4, 0, 2));
        sorter.sort(parallel({-1, 0, 0}, {2, 0.5, 0.5}, 3), order);
        EXPECT_THAT(order.back_to_front, ElementsAre(2, 0, 4, 3, 1));
    }
    EXPECT_THAT(order.layer_begin, IsEmpty());
    EXPECT_THAT(order.cycles, IsEmpty());
    EXPECT_GT(sorter.bytes(), 1000u);
}

TEST(VtkCellCenter, OrdersManyCellsByTheDepthOfTheirCentres)
{
    constexpr int side = 12;
    Mesh mesh;
    for (int z = 0; z <= side; ++z)
        for (int y = 0; y <= side; ++y)
            for (int x = 0; x <= side; ++x)
                mesh.points.emplace_back(x, y, z);
    const auto point = [](int x, int y, int z) { return static_cast<PointId>((z * (side + 1) + y) * (side + 1) + x); };
    for (int z = 0; z < side; ++z)
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                mesh.add(CellShape::hexahedron,
                         std::array{point(x, y, z), point(x + 1, y, z), point(x + 1, y + 1, z), point(x, y + 1, z),
                                    point(x, y, z + 1), point(x + 1, y, z + 1), point(x + 1, y + 1, z + 1),
                                    point(x, y + 1, z + 1)});
    const Scene scene(mesh);
    const glm::dvec3 eye(40, 31, 53);
    const std::vector<CellId> order = sorted(scene, look_at(eye, {6, 6, 6}, 12));
    ASSERT_EQ(order.size(), mesh.cell_count());
    const glm::dvec3 forward = glm::normalize(glm::dvec3(6, 6, 6) - eye);
    double last = std::numeric_limits<double>::infinity();
    for (const CellId cell : order) {
        const glm::dvec3 centre = (mesh.points[mesh.cell(cell)[0]] + mesh.points[mesh.cell(cell)[6]]) / 2.0;
        const double depth = glm::dot(centre, forward);
        EXPECT_LE(depth, last + 1e-5); // VTK's depths are single precision
        last = depth;
    }
}

TEST(VtkCellCenter, TakesEveryShape)
{
    Mesh solids;
    solids.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {2, 0, 0}, {2, 1, 0}, {2, 0, 1}};
    solids.add(CellShape::pyramid, std::array<PointId, 5>{0, 1, 2, 3, 4});
    solids.add(CellShape::tetrahedron, std::array<PointId, 4>{1, 5, 2, 4});
    solids.add(CellShape::wedge, std::array<PointId, 6>{1, 5, 7, 2, 6, 4});
    EXPECT_EQ(sorted(Scene(solids), seen_from({9, 0, 0, 1})).front(), 0u);

    Mesh surface;
    surface.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 5}, {1, 0, 5}, {0, 1, 5}};
    surface.add(CellShape::triangle, std::array<PointId, 3>{3, 4, 5});
    surface.add(CellShape::triangle, std::array<PointId, 3>{0, 1, 2});
    EXPECT_THAT(sorted(Scene(surface), seen_from({0, 0, 9, 1})), ElementsAre(1, 0));
}

TEST(VtkCellCenter, RefusesAnEyeThatIsNowhere)
{
    EXPECT_THROW(sorted(shuffled_row(), seen_from({0, 0, 0, 0})), InputError);
    EXPECT_THROW(sorted(shuffled_row(), seen_from({NAN, 0, 0, 1})), InputError);
}
