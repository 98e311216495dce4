#include "visorder/error.h"
#include "visorder/mesh_arrays.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace visorder::tests {
namespace {

struct Vertex {
    std::int16_t tag;
    float x, y, z;
    double temperature;
};

const std::vector<Vertex> vertices{{7, 0, 0, 0, 1}, {7, 1, 0, 0, 2}, {7, 0, 1, 0, 3}, {7, 0, 0, 1, 4}, {7, 1, 1, 1, 5}};

TEST(MeshArrays, TakeFloatsAndLongIdsFromTheMiddleOfRecords)
{
    const std::vector<long long> ids{0, 1, 2, 3, 1, 2, 3, 4}; // as vtkIdType
    MeshArrays arrays;
    arrays.points = {&vertices[0].x, vertices.size(), sizeof(Vertex)};
    arrays.scalars = {&vertices[0].temperature, vertices.size(), sizeof(Vertex)};
    arrays.connectivity = {ids.data(), ids.size()};
    const Mesh mesh = make_mesh(arrays);
    ASSERT_EQ(mesh.points.size(), 5u);
    EXPECT_EQ(mesh.points[4], glm::dvec3(1, 1, 1));
    EXPECT_EQ(mesh.points[2], glm::dvec3(0, 1, 0));
    EXPECT_EQ(mesh.scalars, (std::vector<float>{1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh.shapes, (std::vector<CellShape>{CellShape::tetrahedron, CellShape::tetrahedron}));
    EXPECT_EQ(mesh.vertices, (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 2, 3, 4}));
    EXPECT_EQ(Scene(mesh).cell_count(), 2u);
}

TEST(MeshArrays, TakeVtksCellsOfAllShapes)
{
    std::vector<double> points;
    for (int z = 0; z < 2; ++z)
        for (int y = 0; y < 2; ++y)
            for (int x = 0; x < 3; ++x)
                for (const int c : {x, y, z})
                    points.push_back(c);
    // A voxel, the same as a hexahedron, a wedge, a pyramid and a tetrahedron.
    const std::vector<std::uint32_t> ids{0, 1, 3, 4, 6, 7,  9, 10, 0, 1, 4, 3, 6, 7, 10, 9,
                                         1, 2, 4, 7, 8, 10, 1, 2,  5, 4, 7, 1, 2, 4, 7};
    const std::vector<std::int32_t> offsets{0, 8, 16, 22, 27, 31};
    const std::array<std::uint8_t, 5> types{11, 12, 13, 14, 10};
    MeshArrays arrays;
    arrays.points = {points.data(), 12};
    arrays.connectivity = std::span<const std::uint32_t>(ids);
    arrays.offsets = std::span<const std::int32_t>(offsets);
    arrays.vtk_types = types;
    const Mesh mesh = make_mesh(arrays);
    EXPECT_EQ(mesh.shapes, (std::vector<CellShape>{CellShape::hexahedron, CellShape::hexahedron, CellShape::wedge,
                                                   CellShape::pyramid, CellShape::tetrahedron}));
    const auto voxel = mesh.cell(0), hexahedron = mesh.cell(1);
    EXPECT_TRUE(std::equal(voxel.begin(), voxel.end(), hexahedron.begin(), hexahedron.end()));
}

TEST(MeshArrays, GoBackwardsByANegativeStride)
{
    const std::vector<std::uint64_t> ids{3, 2, 1, 0};
    MeshArrays arrays;
    arrays.points = {&vertices[0].x, 4, sizeof(Vertex)};
    arrays.connectivity = {&ids[3], 4, -std::ptrdiff_t{sizeof(std::uint64_t)}};
    EXPECT_EQ(make_mesh(arrays).vertices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

std::string fault(const MeshArrays& arrays)
{
    try {
        make_mesh(arrays);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

TEST(MeshArrays, NameWhatIsWrong)
{
    MeshArrays good;
    good.points = {&vertices[0].x, 5, sizeof(Vertex)};
    std::vector<std::int32_t> ids{0, 1, 2, 3, 1, 2, 3, 4}, offsets{0, 4, 8};
    std::vector<std::uint8_t> types{10, 10};
    good.connectivity = {ids.data(), ids.size()};
    good.offsets = {offsets.data(), offsets.size()};
    good.vtk_types = types;
    EXPECT_EQ(fault(good), "none");

    ids[5] = -1;
    EXPECT_EQ(fault(good), "cell 1: there is no point -1");
    ids[5] = 5;
    EXPECT_EQ(fault(good), "cell 1: there is no point 5");
    ids[5] = 2;
    types[1] = 42;
    EXPECT_EQ(fault(good), "cell 1: VTK's cell type 42 cannot be taken");
    types[1] = 12;
    EXPECT_EQ(fault(good), "cell 1: 4 vertices, but a hexahedron has 8");
    types[1] = 10;
    offsets = {0, 9, 8};
    EXPECT_EQ(fault(good), "cell 1: offset 9 is beyond 8 vertices of cells");
    offsets = {8, 4, 8};
    EXPECT_EQ(fault(good), "cell 0: its offsets descend from 8 to 4");
    offsets = {0, 4, 7};
    EXPECT_EQ(fault(good), "offsets end at 7, but there are 8 vertices of cells");
    offsets = {0, 4, 8};
    good.vtk_types = std::span(types).first(1);
    EXPECT_EQ(fault(good), "3 offsets do not fit 1 cell types");
    good.offsets = {};
    EXPECT_EQ(fault(good), "cell types need offsets");
    good.vtk_types = {};
    EXPECT_EQ(fault(good), "none");
    good.connectivity = {ids.data(), 7};
    EXPECT_EQ(fault(good), "7 vertices are not a whole number of cells of 4");
    good.connectivity = {ids.data(), 8};
    good.scalars = {&vertices[0].temperature, 4, sizeof(Vertex)};
    EXPECT_EQ(fault(good), "4 scalars do not fit 5 points");
}

} // namespace
} // namespace visorder::tests
