#include "scenes/generated_scene.h"

#include "geometry/exact_predicates.h"
#include "tests/scenes/face_relations.h"
#include "visorder/error.h"
#include "visorder/mesh.h"
#include "visorder/scene.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <ostream>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace visorder::tests {

using namespace detail;

using namespace scenes;

namespace {

// What is said of a family in scene_families.h. Bodies are the sets of cells that points connect; 0 where larger scenes
// have more. Of surface scenes only the shape, the bodies and the checksum count.
struct Expectation {
    const char* name;
    CellShape shape;
    bool convex;
    bool delaunay;
    bool planar_faces; // before subdivision
    bool face_to_face;
    bool acyclic;
    std::size_t bodies;
    std::uint64_t checksum; // of NAME:3000
};

void PrintTo(const Expectation& expectation, std::ostream* stream)
{
    *stream << expectation.name;
}

constexpr std::array expectations{
    Expectation{"delaunay", CellShape::tetrahedron, true, true, true, true, true, 1, 0x052f9930932f896b},
    Expectation{"carved", CellShape::tetrahedron, false, true, true, true, true, 1, 0xdd4d7880d1f24b67},
    Expectation{"grid", CellShape::hexahedron, true, false, true, true, true, 1, 0xa3d034d555a056a2},
    Expectation{"fin", CellShape::hexahedron, false, false, true, true, true, 1, 0xa27d86ac5ad6593f},
    Expectation{"post", CellShape::hexahedron, false, false, true, true, true, 1, 0x6603d2c5c7bcf539},
    Expectation{"pinwheel", CellShape::tetrahedron, false, false, true, true, false, 3, 0x1abdd5099837e409},
    Expectation{"slivers", CellShape::tetrahedron, true, true, true, true, true, 1, 0xb8b5b61ee7a63303},
    Expectation{"offset", CellShape::tetrahedron, true, true, true, true, true, 1, 0xe41629ba3e1dbcbf},
    Expectation{"contact", CellShape::tetrahedron, false, false, true, false, true, 2, 0x65ce0c9ab0b88209},
    Expectation{"cavity", CellShape::tetrahedron, false, true, true, true, true, 2, 0x76fbfe29da3f674e},
    Expectation{"gear", CellShape::hexahedron, false, false, true, true, true, 1, 0x62d374908775d416},
    Expectation{"gear-helical", CellShape::hexahedron, false, false, false, true, true, 1, 0xe1778ddd7f79ca09},
    Expectation{"reactor", CellShape::hexahedron, false, false, true, true, true, 1, 0xa81126766b2bd161},
    Expectation{"tori", CellShape::hexahedron, false, false, true, true, true, 2, 0x8ce2ea8ca2bb3b3c},
    Expectation{"sphere", CellShape::triangle, false, false, false, false, false, 1, 0x8746f1878645301a},
    Expectation{"shells", CellShape::triangle, false, false, false, false, false, 5, 0xa145e924e3d0adf6},
    Expectation{"knot", CellShape::triangle, false, false, false, false, false, 1, 0xdb30ef99568ccb69},
    Expectation{"cards", CellShape::triangle, false, false, false, false, false, 0, 0x1e3d73567e0f140a},
};

std::vector<Expectation> solids()
{
    std::vector<Expectation> result;
    std::ranges::copy_if(expectations, std::back_inserter(result),
                         [](const Expectation& e) { return e.shape != CellShape::triangle; });
    return result;
}

// Tetrahedra or triangles, counted as the SIZE of a specification counts them.
std::size_t tetrahedra(const Mesh& mesh)
{
    return mesh.cell_count() * (mesh.shapes.front() == CellShape::hexahedron ? 6 : 1);
}

double determinant(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    return glm::dot(glm::cross(a, b), c);
}

// The least determinant of the three edges at a corner, over the corners of a hexahedron or for one of a tetrahedron:
// positive where the vertices stand in VTK's order.
double least_corner(const Mesh& mesh, CellId cell)
{
    const auto vertices = mesh.cell(cell);
    const auto corner = [&](std::uint32_t at, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::dvec3& origin = mesh.points[vertices[at]];
        return determinant(mesh.points[vertices[a]] - origin, mesh.points[vertices[b]] - origin,
                           mesh.points[vertices[c]] - origin);
    };
    if (mesh.shapes[cell] == CellShape::tetrahedron)
        return corner(0, 1, 2, 3);
    double least = corner(0, 1, 3, 4);
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        const std::uint32_t previous = (i + 3) % 4;
        least = std::min({least, corner(i, next, previous, i + 4), corner(i + 4, previous + 4, next + 4, i)});
    }
    return least;
}

// Of every bit of the points, vertices and scalars (FNV-1a, a number at a time).
std::uint64_t checksum(const Mesh& mesh)
{
    std::uint64_t sum = 0xcbf29ce484222325;
    const auto add = [&](std::uint64_t value) { sum = (sum ^ value) * 0x100000001b3; };
    for (const glm::dvec3& point : mesh.points)
        for (int axis = 0; axis < 3; ++axis)
            add(std::bit_cast<std::uint64_t>(point[axis]));
    for (const PointId vertex : mesh.vertices)
        add(vertex);
    for (const float scalar : mesh.scalars)
        add(std::bit_cast<std::uint32_t>(scalar));
    return sum;
}

// Sets of cells that points connect.
std::size_t count_bodies(const Mesh& mesh)
{
    std::vector<PointId> parent(mesh.points.size());
    std::iota(parent.begin(), parent.end(), PointId{0});
    const auto root = [&](PointId point) {
        while (parent[point] != point)
            point = parent[point] = parent[parent[point]];
        return point;
    };
    for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
        for (const PointId vertex : mesh.cell(cell))
            parent[root(vertex)] = root(mesh.cell(cell)[0]);
    std::size_t roots = 0;
    for (PointId point = 0; point < parent.size(); ++point)
        roots += parent[point] == point;
    return roots;
}

// How many cells cannot be ordered since they are in a cycle or behind one.
std::size_t count_unordered(const Relations& behind)
{
    std::vector<std::size_t> waits_for(behind.size(), 0);
    for (const auto& cells : behind)
        for (const CellId cell : cells)
            ++waits_for[cell];
    std::vector<CellId> ready;
    for (CellId cell = 0; cell < behind.size(); ++cell)
        if (waits_for[cell] == 0)
            ready.push_back(cell);
    for (std::size_t i = 0; i < ready.size(); ++i)
        for (const CellId cell : behind[ready[i]])
            if (--waits_for[cell] == 0)
                ready.push_back(cell);
    return behind.size() - ready.size();
}

// Parallel, far, near, inside, and in the planes of grid lines.
std::vector<glm::dvec4> various_eyes(const Mesh& mesh)
{
    Box bounds;
    for (const glm::dvec3& point : mesh.points)
        bounds.add(point);
    const glm::dvec3 extent = bounds.max - bounds.min;
    std::mt19937_64 random(7);
    std::vector<glm::dvec4> eyes;
    for (int i = 0; i < 6; ++i) {
        eyes.emplace_back(random_direction(random), 0);
        eyes.emplace_back(bounds.middle() + 100.0 * glm::length(extent) * random_direction(random), 1);
        eyes.emplace_back(bounds.middle() + extent * random_direction(random), 1);
        eyes.emplace_back(bounds.middle() + 0.4 * extent * random_direction(random), 1);
        eyes.emplace_back(mesh.points[random() % mesh.points.size()], 1);
    }
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec4 along(0);
        along[axis] = 1;
        eyes.push_back(along);
    }
    eyes.emplace_back(bounds.min, 1);
    return eyes;
}

class GeneratedSceneOf : public testing::TestWithParam<Expectation> {
protected:
    std::string specification(std::size_t size, int seed = 1) const
    {
        return std::string(GetParam().name) + ":" + std::to_string(size) + ":" + std::to_string(seed);
    }
};

class GeneratedSolidsOf : public GeneratedSceneOf {};

std::string test_name(const testing::TestParamInfo<Expectation>& family)
{
    std::string name = family.param.name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(EachFamily, GeneratedSceneOf, testing::ValuesIn(expectations), test_name);
INSTANTIATE_TEST_SUITE_P(EachFamily, GeneratedSolidsOf, testing::ValuesIn(solids()), test_name);

} // namespace

TEST(GeneratedScene, EveryFamilyIsExpected)
{
    ASSERT_EQ(generated_scenes().size(), expectations.size());
    for (const GeneratedScene& scene : generated_scenes()) {
        SCOPED_TRACE(scene.name);
        EXPECT_EQ(std::count_if(expectations.begin(), expectations.end(),
                                [&](const Expectation& e) { return std::string_view(e.name) == scene.name; }),
                  1);
        EXPECT_FALSE(std::string_view(scene.summary).empty());
    }
}

TEST_P(GeneratedSceneOf, IsTheSameEveryTime)
{
    const Mesh first = generate(specification(20'000, 5));
    const Mesh second = generate(specification(20'000, 5));
    EXPECT_EQ(first.points, second.points);
    EXPECT_EQ(first.shapes, second.shapes);
    EXPECT_EQ(first.offsets, second.offsets);
    EXPECT_EQ(first.vertices, second.vertices);
    EXPECT_EQ(first.scalars, second.scalars);
}

TEST_P(GeneratedSceneOf, IsTheSameOnEveryMachine)
{
    EXPECT_EQ(checksum(generate(specification(3000))), GetParam().checksum)
        << std::hex << checksum(generate(specification(3000)))
        << ": if the scene was meant to change, results from before cannot be compared with those from now";
}

TEST_P(GeneratedSceneOf, HasAboutAsManyCellsAsAskedFor)
{
    const auto family = std::find_if(generated_scenes().begin(), generated_scenes().end(),
                                     [](const auto& scene) { return std::string_view(scene.name) == GetParam().name; });
    EXPECT_NEAR(static_cast<double>(tetrahedra(generate(GetParam().name))), static_cast<double>(family->default_cells),
                0.05 * static_cast<double>(family->default_cells));
    for (const std::size_t size : {2000, 7500, 30'000})
        for (const int seed : {1, 2}) {
            SCOPED_TRACE(specification(size, seed));
            const auto asked = static_cast<double>(size);
            EXPECT_NEAR(static_cast<double>(tetrahedra(generate(specification(size, seed)))), asked, 0.15 * asked);
        }
}

TEST_P(GeneratedSceneOf, IsAValidMeshOfItsShapeWithSmoothScalars)
{
    const Mesh mesh = generate(specification(20'000));
    EXPECT_NO_THROW(validate(mesh));
    EXPECT_TRUE(std::ranges::all_of(mesh.shapes, [](CellShape shape) { return shape == GetParam().shape; }));
    ASSERT_EQ(mesh.scalars.size(), mesh.points.size());
    const auto [lowest, highest] = std::minmax_element(mesh.scalars.begin(), mesh.scalars.end());
    EXPECT_GE(*lowest, 0);
    EXPECT_LE(*highest, 1);
    EXPECT_GT(*highest - *lowest, 0.3);
    std::vector<char> used(mesh.points.size(), 0);
    for (const PointId vertex : mesh.vertices)
        used[vertex] = 1;
    EXPECT_TRUE(std::ranges::all_of(used, [](char u) { return u == 1; }));
}

TEST_P(GeneratedSolidsOf, HasCellsOfPositiveVolumeInVtksOrder)
{
    const bool slivers = std::string_view(GetParam().name) == "slivers";
    for (const std::size_t size : {2000, 50'000}) {
        const Mesh mesh = generate(specification(size));
        const Mesh tetrahedra = subdivide(mesh).mesh;
        for (CellId cell = 0; cell < mesh.cell_count(); ++cell)
            EXPECT_GE(least_corner(mesh, cell), slivers ? 0 : std::numeric_limits<double>::min()) << "cell " << cell;
        for (CellId cell = 0; cell < tetrahedra.cell_count(); ++cell)
            EXPECT_GE(least_corner(tetrahedra, cell), slivers ? 0 : std::numeric_limits<double>::min())
                << "tetrahedron " << cell;
    }
}

TEST_P(GeneratedSolidsOf, HasFacesOfAtMostTwoCellsOnItsTwoSides)
{
    Mesh mesh = generate(specification(20'000));
    if (!GetParam().planar_faces)
        mesh = subdivide(mesh).mesh;
    const auto far_vertex = [&](const Owner& owner) {
        const auto corners = face_vertices(mesh.shapes[owner.cell], owner.face);
        const int count = vertex_count(mesh.shapes[owner.cell]);
        int vertex = 0;
        while (vertex < count && std::ranges::find(corners, vertex) != corners.end())
            ++vertex;
        return mesh.points[mesh.cell(owner.cell)[static_cast<std::size_t>(vertex)]];
    };
    for (const auto& [key, owners] : owners_of_faces(mesh)) {
        ASSERT_LE(owners.size(), 2u);
        if (owners.size() < 2)
            continue;
        const auto corners = face_vertices(mesh.shapes[owners[0].cell], owners[0].face);
        const auto point = [&](std::size_t i) { return mesh.points[mesh.cell(owners[0].cell)[corners[i]]]; };
        EXPECT_EQ(side_of_plane(point(0), point(1), point(2), far_vertex(owners[0])), Sign::negative);
        EXPECT_EQ(side_of_plane(point(0), point(1), point(2), far_vertex(owners[1])), Sign::positive);
        EXPECT_EQ(side_of_plane(point(0), point(1), point(2), point(corners.size() - 1)), Sign::zero) << "not planar";
    }
}

TEST_P(GeneratedSceneOf, HangsTogetherInItsBodies)
{
    for (const std::size_t size : {2000, 20'000})
        for (const int seed : {1, 2, 3}) {
            SCOPED_TRACE(specification(size, seed));
            const std::size_t bodies = count_bodies(generate(specification(size, seed)));
            if (GetParam().bodies > 0) {
                EXPECT_EQ(bodies, GetParam().bodies);
            } else {
                EXPECT_EQ(bodies, size / 2);
            }
        }
}

TEST_P(GeneratedSolidsOf, HasTheTraitsItsFamilyPromises)
{
    const Mesh whole = generate(specification(3000));
    for (const bool subdivided : {false, true}) {
        const Scene scene(subdivided ? subdivide(whole).mesh : whole);
        const bool planar = subdivided || GetParam().planar_faces;
        const Traits& traits = scene.traits();
        EXPECT_EQ(traits.convex, GetParam().convex);
        EXPECT_EQ(traits.face_to_face, planar && GetParam().face_to_face);
        EXPECT_EQ(traits.planar_faces, planar);
        EXPECT_EQ(traits.flat_cells, 0u);
        EXPECT_EQ(traits.inverted_cells, 0u);
        EXPECT_EQ(traits.folded_faces, 0u);
        // Boxes of a lattice are Delaunay once cut.
        EXPECT_TRUE(subdivided || traits.delaunay == GetParam().delaunay);
    }
}

TEST_P(GeneratedSolidsOf, HasNoCellsThatOverlap)
{
    EXPECT_TRUE(Scene(subdivide(generate(specification(2000))).mesh).overlapping_cells().empty());
}

TEST(GeneratedScene, HasNoCycleAcrossFacesUnlessItIsMeantTo)
{
    for (const Expectation& expectation : expectations) {
        if (!expectation.acyclic)
            continue;
        const Mesh mesh = generate(std::string(expectation.name) + ":3000");
        const Mesh tetrahedra = subdivide(mesh).mesh;
        for (const glm::dvec4& eye : various_eyes(mesh)) {
            SCOPED_TRACE(testing::Message()
                         << expectation.name << ":3000 from " << eye.x << " " << eye.y << " " << eye.z << " " << eye.w);
            if (expectation.planar_faces) {
                EXPECT_EQ(count_unordered(relations_across_faces(mesh, eye)), 0u);
            }
            EXPECT_EQ(count_unordered(relations_across_faces(tetrahedra, eye)), 0u);
        }
    }
}

TEST(GeneratedScene, SeedsMakeDifferentRandomScenes)
{
    for (const std::string name : {"delaunay", "carved", "slivers", "offset", "contact", "cavity", "cards"}) {
        SCOPED_TRACE(name);
        EXPECT_NE(generate(name + ":2000:1").points, generate(name + ":2000:2").points);
        EXPECT_EQ(generate(name + ":2000").points, generate(name + ":2000:1").points);
    }
    for (const std::string name :
         {"grid", "fin", "post", "pinwheel", "gear", "gear-helical", "reactor", "tori", "sphere", "shells", "knot"}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(generate(name + ":2000:1").points, generate(name + ":2000:2").points);
    }
}

TEST(GeneratedScene, SmallestOfEachFamilyExists)
{
    for (const GeneratedScene& scene : generated_scenes()) {
        std::size_t size = 1;
        for (bool made = false; !made; ++size)
            try {
                const Mesh mesh = generate(std::string(scene.name) + ":" + std::to_string(size));
                made = true;
                SCOPED_TRACE(testing::Message() << scene.name << ":" << size);
                EXPECT_NO_THROW(validate(mesh));
                EXPECT_NEAR(static_cast<double>(tetrahedra(mesh)), static_cast<double>(size),
                            0.35 * static_cast<double>(size));
                for (CellId cell = 0; mesh.shapes[0] != CellShape::triangle && cell < mesh.cell_count(); ++cell)
                    EXPECT_GT(least_corner(mesh, cell), 0) << "cell " << cell;
            } catch (const InputError&) {
            }
        EXPECT_LE(size, 2001u) << scene.name;
    }
}

TEST(GeneratedScene, RefusesWhatItDoesNotUnderstand)
{
    for (const char* const specification : {"",
                                            "nonesuch",
                                            "Delaunay",
                                            ":1000",
                                            "delaunay ",
                                            "delaunay:",
                                            "delaunay:0",
                                            "delaunay:-5",
                                            "delaunay:+5",
                                            "delaunay:1e5",
                                            "delaunay:1000.5",
                                            "delaunay: 1000",
                                            "delaunay:1000x",
                                            "delaunay:99",
                                            "delaunay:536870913",
                                            "delaunay:99999999999999999999",
                                            "delaunay:1000:",
                                            "delaunay:1000:x",
                                            "delaunay:1000:-1",
                                            "delaunay:1000:18446744073709551616",
                                            "delaunay:1000:1:1",
                                            "delaunay::1",
                                            "pinwheel:47",
                                            "grid:5"}) {
        SCOPED_TRACE(specification);
        try {
            generate(specification);
            ADD_FAILURE() << "accepted";
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_FALSE(message.empty());
            EXPECT_EQ(message.find('\n'), std::string::npos);
        }
    }
}

TEST(GeneratedScene, ListsTheKnownNamesForAnUnknownOne)
{
    try {
        generate("nonesuch:1000");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        for (const GeneratedScene& scene : generated_scenes())
            EXPECT_NE(std::string(error.what()).find(scene.name), std::string::npos) << scene.name;
    }
}

} // namespace visorder::tests
