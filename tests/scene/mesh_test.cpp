#include "visorder/error.h"
#include "visorder/mesh.h"

#include <algorithm>
#include <array>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <oneapi/tbb/global_control.h>
#include <random>
#include <string>
#include <tuple>

namespace visorder::tests {
namespace {

/// Two tetrahedra that share a face.
Mesh two_tetrahedra()
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 2, 3});
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{1, 4, 2, 3});
    return mesh;
}

/// A row of tetrahedra, long enough for `validate` to spread over threads.
Mesh long_row(std::size_t cells)
{
    Mesh mesh;
    for (std::size_t i = 0; i < cells + 3; ++i)
        mesh.points.emplace_back(static_cast<double>(i), static_cast<double>(i % 2), static_cast<double>(i % 3));
    for (PointId i = 0; i < cells; ++i)
        mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{i, i + 1, i + 2, i + 3});
    return mesh;
}

/// What `validate` says of a mesh; empty if it is valid.
std::string fault(const Mesh& mesh)
{
    try {
        validate(mesh);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

std::string fault_after(const std::function<void(Mesh&)>& change)
{
    Mesh mesh = two_tetrahedra();
    change(mesh);
    return fault(mesh);
}

TEST(Mesh, AddAppendsCellsOfDifferentShapes)
{
    Mesh mesh;
    mesh.add(CellShape::pyramid, std::array<PointId, 5>{0, 1, 2, 3, 4});
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{9, 8, 7, 6});
    EXPECT_EQ(mesh.cell_count(), 2u);
    EXPECT_EQ(mesh.offsets, (std::vector<std::uint32_t>{0, 5, 9}));
    EXPECT_EQ(mesh.cell(0).size(), 5u);
    EXPECT_EQ(mesh.cell(1)[0], 9u);
    EXPECT_EQ(mesh.cell(1)[3], 6u);
}

TEST(Mesh, ValidMeshesPass)
{
    EXPECT_EQ(fault(two_tetrahedra()), "");
    EXPECT_EQ(fault(long_row(20'000)), "");
    Mesh with_scalars = two_tetrahedra();
    with_scalars.scalars.assign(5, 0.5f);
    EXPECT_EQ(fault(with_scalars), "");
    // A scalar is no coordinate: it has no part in an order, whatever it is.
    with_scalars.scalars[2] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(fault(with_scalars), "");

    Mesh collapsed = two_tetrahedra();
    collapsed.vertices[3] = 0;
    EXPECT_EQ(fault(collapsed), "");

    Mesh surface;
    surface.points = two_tetrahedra().points;
    surface.add(CellShape::triangle, std::array<PointId, 3>{0, 1, 4});
    EXPECT_EQ(fault(surface), "");
}

TEST(Mesh, FaultsAreNamed)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();

    EXPECT_EQ(fault(Mesh{}), "the mesh has no cells");
    EXPECT_EQ(fault_after([](Mesh& m) { m.offsets.pop_back(); }), "2 offsets do not fit 2 cells, which take 3");
    EXPECT_EQ(fault_after([](Mesh& m) { m.offsets[0] = 1; }), "cell 0: the first offset is 1, not 0");
    EXPECT_EQ(fault_after([](Mesh& m) { m.offsets[1] = 5; }), "cell 0: a tetrahedron has 4 vertices, not 5");
    EXPECT_EQ(fault_after([](Mesh& m) { m.offsets[2] = 3; }), "cell 1: offsets fall from 4 to 3");
    EXPECT_EQ(fault_after([](Mesh& m) { m.vertices.pop_back(); }), "cell 1: offset 8 is beyond the 7 vertices");
    EXPECT_EQ(fault_after([](Mesh& m) { m.vertices.push_back(0); }),
              "cell 1: the last offset is 8, but there are 9 vertices");
    EXPECT_EQ(fault_after([](Mesh& m) { m.shapes[1] = CellShape::wedge; }), "cell 1: a wedge has 6 vertices, not 4");
    EXPECT_EQ(fault_after([](Mesh& m) { m.shapes[1] = static_cast<CellShape>(17); }), "cell 1: unknown shape 17");
    EXPECT_EQ(fault_after([](Mesh& m) { m.shapes[1] = CellShape::triangle; }),
              "cell 1: a triangle in a mesh that began with a tetrahedron: triangles and solids do not mix");
    EXPECT_EQ(fault_after([](Mesh& m) { m.vertices[6] = 5; }), "cell 1: point 5 is out of range, there are 5");
    EXPECT_EQ(fault_after([](Mesh& m) { m.points[3].y = nan; }), "point 3: coordinates (0, nan, 1) are not finite");
    EXPECT_EQ(fault_after([](Mesh& m) { m.points[4].x = -infinity; }),
              "point 4: coordinates (-inf, 1, 1) are not finite");
    EXPECT_EQ(fault_after([](Mesh& m) { m.scalars.assign(4, 0.f); }), "4 scalars do not fit 5 points");
}

TEST(Mesh, TheLowestFaultIsNamedOnAnyNumberOfThreads)
{
    Mesh mesh = long_row(100'000);
    for (std::size_t cell = 99'999; cell > 30'000; cell -= 7)
        mesh.vertices[4 * cell + 2] = 4'000'000'000;
    for (std::size_t point = 99'999; point > 100; point -= 100)
        mesh.points[point].z = std::numeric_limits<double>::infinity();
    for (const std::size_t threads : {1u, 2u, 8u}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        for (int repetition = 0; repetition < 10; ++repetition)
            EXPECT_EQ(fault(mesh), "cell 30006: point 4000000000 is out of range, there are 100003");
    }
    mesh.vertices = long_row(100'000).vertices;
    for (int repetition = 0; repetition < 10; ++repetition)
        EXPECT_EQ(fault(mesh), "point 199: coordinates (199, 1, inf) are not finite");
}

TEST(Weld, JoinsEqualPointsAndKeepsTheFirstOfEach)
{
    Mesh mesh;
    mesh.points = {{5, 0, 0}, {1, 2, 3}, {5, -0.0, 0}, {0, 0, 0}, {1, 2, 3}, {-0.0, 0, -0.0}, {7, 7, 7}};
    mesh.scalars = {0, 1, 2, 3, 4, 5, 6};
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{2, 4, 5, 6});
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 3, 6});

    EXPECT_EQ(weld(mesh), 3u);
    EXPECT_EQ(mesh.points, (std::vector<glm::dvec3>{{5, 0, 0}, {1, 2, 3}, {0, 0, 0}, {7, 7, 7}}));
    EXPECT_EQ(mesh.scalars, (std::vector<float>{0, 1, 3, 6}));
    EXPECT_EQ(mesh.vertices, (std::vector<PointId>{0, 1, 2, 3, 0, 1, 2, 3}));
    EXPECT_EQ(weld(mesh), 0u);
    EXPECT_EQ(mesh.points.size(), 4u);
}

TEST(Weld, AgreesWithAnOrderedMap)
{
    std::mt19937 random(1);
    for (int round = 0; round < 20; ++round) {
        Mesh mesh;
        std::uniform_int_distribution<int> coordinate(-round, round);
        for (int i = 0; i < 2000; ++i)
            mesh.points.emplace_back(coordinate(random), 0.1 * coordinate(random), 1e300 * coordinate(random));
        for (PointId i = 0; i < 2000; i += 4)
            mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{i, i + 1, i + 2, i + 3});

        std::map<std::tuple<double, double, double>, PointId> seen;
        std::vector<glm::dvec3> kept;
        std::vector<PointId> vertices;
        for (const glm::dvec3& p : mesh.points) {
            const auto [entry, is_new] = seen.try_emplace({p.x, p.y, p.z}, static_cast<PointId>(kept.size()));
            if (is_new)
                kept.push_back(p);
            vertices.push_back(entry->second);
        }

        EXPECT_EQ(weld(mesh), 2000 - kept.size());
        EXPECT_EQ(mesh.points, kept);
        EXPECT_EQ(mesh.vertices, vertices);
    }
}

TEST(Weld, JoinsPointsWithinATolerance)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1e-9, 0, -1e-9}, {1, 1e-7, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1 + 1e-9, 0}};
    mesh.scalars = {0, 1, 2, 3, 4, 5, 6};
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{2, 3, 6, 5});
    Mesh exactly = mesh;
    EXPECT_EQ(weld(exactly, 0), 0u);
    EXPECT_EQ(weld(mesh, 1e-8), 2u);
    EXPECT_EQ(mesh.points, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1e-7, 0}, {0, 1, 0}, {0, 0, 1}}));
    EXPECT_EQ(mesh.scalars, (std::vector<float>{0, 1, 3, 4, 5}));
    EXPECT_EQ(mesh.vertices, (std::vector<PointId>{0, 2, 3, 4}));
    for (const double bad : {-1e-3, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(weld(mesh, bad), InputError);
}

TEST(Weld, WithAToleranceAgreesWithTryingAllPoints)
{
    std::mt19937 random(4);
    for (int round = 0; round < 20; ++round) {
        Mesh mesh;
        const double far = round % 2 == 0 ? 0 : 1e6;
        std::uniform_real_distribution<double> coordinate(far, far + 1);
        for (int i = 0; i < 400; ++i)
            mesh.points.emplace_back(coordinate(random), coordinate(random), -coordinate(random));
        mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 2, 3});
        const double tolerance = 0.02 * (1 + round);
        std::vector<glm::dvec3> kept;
        for (const glm::dvec3& p : mesh.points)
            if (std::none_of(kept.begin(), kept.end(),
                             [&](const glm::dvec3& other) { return glm::distance(p, other) <= tolerance; }))
                kept.push_back(p);
        weld(mesh, tolerance);
        EXPECT_EQ(mesh.points, kept) << "round " << round;
    }
}

TEST(Weld, LeavesFaultsForValidateToName)
{
    Mesh mesh = two_tetrahedra();
    mesh.points[4] = mesh.points[0];
    mesh.vertices[3] = 5;
    weld(mesh);
    EXPECT_EQ(fault(mesh), "cell 0: point 5 is out of range, there are 4");

    Mesh nowhere = two_tetrahedra();
    nowhere.points[1].x = nowhere.points[3].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(weld(nowhere), 0u);

    Mesh misfit = two_tetrahedra();
    misfit.scalars.assign(4, 0.f);
    EXPECT_THROW(weld(misfit), InputError);
}

} // namespace
} // namespace visorder::tests
