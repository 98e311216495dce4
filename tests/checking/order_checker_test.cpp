#include "audit_scenes.h"
#include "brute_force.h"
#include "expectations.h"
#include "scene/orientations.h"
#include "scene/overlapping_cells.h"
#include "small_scenes.h"
#include "visorder/checking.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <numeric>
#include <oneapi/tbb/global_control.h>
#include <sstream>
#include <string_view>

namespace visorder::tests {

using namespace detail;
namespace {

using Matrix = std::vector<std::vector<bool>>; // [front][back], inner numbering

Matrix matrix(const Scene& scene)
{
    return Matrix(scene.cell_count(), std::vector<bool>(scene.cell_count(), false));
}

template <class T>
Matrix obstructions(const Scene& scene, const glm::dvec4& eye)
{
    Matrix result = matrix(scene);
    const auto solid = [&](CellId cell) { return scene.orientations().sign[cell] != 0; };
    for (CellId a = 0; a < scene.cell_count(); ++a)
        for (CellId b = 0; b < scene.cell_count(); ++b)
            result[a][b] = a != b && solid(a) && solid(b) && brute_force::obstructs<T>(scene, a, b, eye);
    return result;
}

Matrix closure(Matrix reaches)
{
    const std::size_t n = reaches.size();
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; reaches[i][k] && j < n; ++j)
                reaches[i][j] = reaches[i][j] || reaches[k][j];
    return reaches;
}

Matrix matrix_of(const Scene& scene, const Relations& relations)
{
    Matrix result = matrix(scene);
    std::size_t count = 0;
    relations.visit([&](CellId front, CellId back) {
        EXPECT_FALSE(result[front][back]) << "a relation counted twice";
        result[front][back] = true;
        ++count;
    });
    EXPECT_EQ(count, relations.count());
    return result;
}

Order random_order(const Scene& scene, Random& random)
{
    Order order;
    order.back_to_front.resize(scene.cell_count());
    std::iota(order.back_to_front.begin(), order.back_to_front.end(), 0u);
    for (std::size_t i = order.back_to_front.size(); i > 1; --i)
        std::swap(order.back_to_front[i - 1],
                  order.back_to_front[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
    return order;
}

// By choosing again and again any cell that obstructs none of those left; where there is none, any cell.
Order topological_order(const Scene& scene, const Matrix& obstructs, Random& random)
{
    Order order;
    std::vector<CellId> left(scene.cell_count());
    std::iota(left.begin(), left.end(), 0u);
    while (!left.empty()) {
        const auto start = static_cast<std::size_t>(random.below(static_cast<int>(left.size())));
        std::rotate(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(start), left.end());
        auto next = std::find_if(left.begin(), left.end(), [&](CellId a) {
            return std::none_of(left.begin(), left.end(), [&](CellId b) { return obstructs[a][b]; });
        });
        if (next == left.end())
            next = left.begin();
        order.back_to_front.push_back(scene.caller_cells()[*next]);
        left.erase(next);
    }
    return order;
}

struct Expected {
    std::size_t violations = 0;
    std::size_t violations_in_cycles = 0;
    std::vector<std::pair<CellId, CellId>> first;
    std::vector<std::vector<CellId>> unorderable;
};

// What a check must say, by the closure of the relations.
Expected expected_of(const Scene& scene, const Matrix& relations, const Matrix& reaches, const Order& order)
{
    Expected expected;
    std::vector<std::size_t> place(scene.cell_count());
    for (std::size_t i = 0; i < order.back_to_front.size(); ++i)
        place[order.back_to_front[i]] = i;
    const auto caller = scene.caller_cells();
    for (CellId a = 0; a < scene.cell_count(); ++a)
        for (CellId b = 0; b < scene.cell_count(); ++b)
            if (relations[a][b] && place[caller[a]] < place[caller[b]]) {
                if (reaches[b][a]) {
                    ++expected.violations_in_cycles;
                } else {
                    ++expected.violations;
                    expected.first.emplace_back(caller[a], caller[b]);
                }
            }
    std::sort(expected.first.begin(), expected.first.end());
    std::vector<bool> done(scene.cell_count(), false);
    for (CellId a = 0; a < scene.cell_count(); ++a) {
        if (!reaches[a][a] || done[a])
            continue;
        std::vector<CellId>& set = expected.unorderable.emplace_back();
        for (CellId b = 0; b < scene.cell_count(); ++b)
            if (reaches[a][b] && reaches[b][a]) {
                set.push_back(caller[b]);
                done[b] = true;
            }
        std::sort(set.begin(), set.end());
    }
    std::sort(expected.unorderable.begin(), expected.unorderable.end());
    return expected;
}

// Whether the ray from the eye to the witness passes through the front cell before it, and enters the back cell there,
// to within rounding: the witness, moved a little along the ray, is in the back cell, and not in it the other way.
void expect_witness(const Scene& scene, const glm::dvec4& eye, const Violation& violation)
{
    const auto cells = scene.caller_cells();
    const auto inner = [&](CellId caller) {
        return static_cast<CellId>(std::find(cells.begin(), cells.end(), caller) - cells.begin());
    };
    const CellId front = inner(violation.front), back = inner(violation.back);
    const glm::dvec3 away = eye.w == 0 ? -glm::dvec3(eye) : violation.witness - glm::dvec3(eye) / eye.w;
    // The range of the ray witness + t away within a cell.
    const auto range = [&](CellId cell) {
        std::pair<double, double> t{-1e300, 1e300};
        for (int face = 0; face < face_count(scene.mesh().shapes[cell]); ++face) {
            const FaceLoop loop = face_loop(scene.mesh(), cell, face);
            const auto triple = spanning_triple(scene.mesh(), loop);
            if (!triple)
                continue;
            const auto& points = scene.mesh().points;
            const glm::dvec3 n =
                static_cast<double>(scene.orientations().sign[cell]) *
                glm::cross(points[triple->b] - points[triple->a], points[triple->c] - points[triple->a]);
            const double height = glm::dot(n, violation.witness - points[triple->a]), slope = glm::dot(n, away);
            if (slope > 0)
                t.second = std::min(t.second, -height / slope);
            if (slope < 0)
                t.first = std::max(t.first, -height / slope);
            if (slope == 0 && height > 1e-9 * glm::length(n)) {
                t = {1, -1};
            }
        }
        return t;
    };
    const auto in_front = range(front), in_back = range(back);
    EXPECT_LT(in_front.first, in_front.second);
    EXPECT_LT(in_back.first, in_back.second);
    EXPECT_LE(in_front.second, 1e-9);
    EXPECT_NEAR(in_back.first, 0, 1e-9);
    EXPECT_GT(in_back.second, 0);
}

std::string reproduce(const std::string& name, const glm::dvec4& eye)
{
    std::ostringstream text;
    text << name << " from (" << eye.x << ", " << eye.y << ", " << eye.z << ", " << eye.w << ")";
    return text.str();
}

// The relations against the definition of "obstructs", and checks of orders against the relations.
template <class T>
void expect_truth(const std::string& name, const Mesh& mesh, const std::vector<glm::dvec4>& eyes, bool witnesses)
{
    const Scene scene(mesh);
    const OrderChecker checker(scene);
    Random random(17);
    for (const glm::dvec4& eye : eyes) {
        SCOPED_TRACE(reproduce(name, eye));
        const Matrix truth = obstructions<T>(scene, eye);
        const Relations relations = checker.relations_at(eye);
        const Matrix known = matrix_of(scene, relations);
        const Matrix reaches = closure(known);
        for (CellId a = 0; a < scene.cell_count(); ++a)
            for (CellId b = 0; b < scene.cell_count(); ++b) {
                const bool solids = scene.orientations().sign[a] != 0 && scene.orientations().sign[b] != 0;
                ASSERT_TRUE(reaches[a][b] || !truth[a][b]) << a << " obstructs " << b << ", but no relations say so";
                ASSERT_TRUE(truth[a][b] || !known[a][b] || !solids) << a << " does not obstruct " << b;
            }
        for (int i = 0; i < 4; ++i) {
            const Order order = i == 0 ? topological_order(scene, known, random) : random_order(scene, random);
            const CheckResult result = checker.check(relations, order, {1000000});
            const Expected expected = expected_of(scene, known, reaches, order);
            EXPECT_EQ(result.relations, relations.count());
            EXPECT_EQ(result.violations, expected.violations);
            EXPECT_EQ(result.violations_in_cycles, expected.violations_in_cycles);
            EXPECT_TRUE(result.overlapping.empty());
            if (expected.violations + expected.violations_in_cycles > 0) {
                EXPECT_EQ(result.unorderable, expected.unorderable);
            }
            std::vector<std::pair<CellId, CellId>> pairs;
            for (const Violation& violation : result.witnesses) {
                pairs.emplace_back(violation.front, violation.back);
                if (witnesses)
                    expect_witness(scene, eye, violation);
            }
            EXPECT_EQ(pairs, expected.first);
            // Right if and only if no pair of the definition is out of order.
            std::vector<std::size_t> place(scene.cell_count());
            for (std::size_t k = 0; k < order.back_to_front.size(); ++k)
                place[order.back_to_front[k]] = k;
            bool right = true;
            for (CellId a = 0; a < scene.cell_count(); ++a)
                for (CellId b = 0; b < scene.cell_count(); ++b)
                    right = right && !(truth[a][b] && place[scene.caller_cells()[a]] < place[scene.caller_cells()[b]]);
            if (scene.orientations().flat == 0) {
                EXPECT_EQ(result.violations + result.violations_in_cycles == 0, right);
            } else if (result.violations + result.violations_in_cycles == 0) {
                EXPECT_TRUE(right); // relations through flat cells may ask for more
            }
        }
    }
}

TEST(OrderChecker, KnowsExactlyWhatObstructsWhatInSmallScenes)
{
    std::uint64_t seed = 0;
    for (const SmallScene& small : small_scenes())
        expect_truth<std::int64_t>(small.name, small.mesh, small_scene_eyes(Scene(small.mesh), ++seed), true);
}

TEST(OrderChecker, KnowsExactlyWhatObstructsWhatAtAllDoublePrecisionCoordinates)
{
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        Random random(seed);
        Mesh mesh = carved_delaunay(7, 50, 0.6, seed);
        for (glm::dvec3& p : mesh.points)
            p = p * 0.1 + glm::dvec3(random.real(), random.real(), random.real()) * 1e-3;
        const std::vector<glm::dvec4> eyes{{random.real() * 9, random.real() * 9, 11, 1},
                                           {random.real() * 3, random.real() * 3, random.real() * 3, 1},
                                           glm::dvec4(mesh.points[2], 1),
                                           glm::dvec4((mesh.points[0] + mesh.points[1]) * 0.5, 1),
                                           glm::dvec4(mesh.points[3] + 1e-12, 1),
                                           {1e9, 2e9, -1e9, 1},
                                           {0, 1, 0, 0},
                                           {random.real(), random.real(), random.real(), 0}};
        expect_truth<brute_force::Number>("moved delaunay " + std::to_string(seed), mesh, eyes, false);
    }
}

TEST(OrderChecker, RelationsRunThroughFlatCells)
{
    // Two tetrahedra above a square with a diagonal one way, two below with a diagonal the other way, and the flat
    // tetrahedron of the square in between: no face is shared by two solids of different sides.
    for (const bool turned : {false, true}) {
        Mesh mesh;
        mesh.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 4}, {2, 2, -4}};
        if (turned)
            mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{1, 0, 2, 3});
        else
            mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 2, 3});
        mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 2, 4});
        mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 2, 3, 4});
        mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{0, 1, 3, 5});
        mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{1, 2, 3, 5});
        const std::vector<glm::dvec4> eyes{{1, 2, 20, 1}, {1, 2, -20, 1}, {1, 2, 3, 0}, {-7, 9, 3, 1},
                                           {9, 1, 0, 1},  {2, 1, 1, 1},   {0, 0, 1, 0}, {1, 2, -3, 0}};
        expect_truth<std::int64_t>("flat cell", mesh, eyes, false);
        const Scene scene(mesh);
        const OrderChecker checker(scene);
        const Order from_above{{4, 3, 0, 1, 2}, {}, {}}, from_below{{1, 2, 0, 4, 3}, {}, {}};
        EXPECT_EQ(checker.check(eyes[0], from_above).violations, 0u);
        EXPECT_GT(checker.check(eyes[0], from_below).violations, 0u);
        EXPECT_EQ(checker.check(eyes[1], from_below).violations, 0u);
        EXPECT_GT(checker.check(eyes[1], from_above).violations, 0u);
    }
}

// Three boards around an axis, each end resting on the next.
Mesh ring_of_boards()
{
    Mesh mesh;
    const auto board = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& width) {
        const auto first = static_cast<PointId>(mesh.points.size());
        const glm::dvec3 up(0, 0, 1);
        for (const glm::dvec3& p : {a, b, b + width, a + width, a + up, b + up, b + width + up, a + width + up})
            mesh.points.push_back(p);
        std::array<PointId, 8> v;
        std::iota(v.begin(), v.end(), first);
        mesh.add(CellShape::hexahedron, v);
    };
    board({0, 0, 0}, {12, 0, 4}, {0, 2, 0});
    board({10, 0, 0}, {10, 12, 4}, {2, 0, 0});
    board({12, 10, 0}, {0, 10, 4}, {0, 2, 0});
    board({0, 12, 0}, {0, 0, 4}, {2, 0, 0});
    return mesh;
}

TEST(OrderChecker, ReportsSetsThatNoOrderSatisfies)
{
    Mesh mesh = ring_of_boards();
    // And two cells apart from the ring, one behind the other.
    const auto first = static_cast<PointId>(mesh.points.size());
    for (const double z : {0.0, 9.0})
        for (const glm::dvec3& p :
             {glm::dvec3(20, 0, z), glm::dvec3(25, 0, z), glm::dvec3(20, 5, z), glm::dvec3(21, 1, z + 3)})
            mesh.points.push_back(p);
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{first, first + 1, first + 2, first + 3});
    mesh.add(CellShape::tetrahedron, std::array<PointId, 4>{first + 4, first + 5, first + 6, first + 7});
    const Scene scene(mesh);
    const OrderChecker checker(scene);
    const glm::dvec4 eye(0, 0, 1, 0);
    const CheckResult good = checker.check(eye, {{0, 1, 2, 3, 4, 5}, {}, {}});
    EXPECT_EQ(good.unorderable, (std::vector<std::vector<CellId>>{{0, 1, 2, 3}}));
    EXPECT_FALSE(good.order_exists());
    EXPECT_EQ(good.relations, 5u);
    EXPECT_EQ(good.violations, 0u);
    EXPECT_GE(good.violations_in_cycles, 1u);
    EXPECT_TRUE(good.overlapping.empty());
    const CheckResult bad = checker.check(eye, {{0, 5, 1, 2, 4, 3}, {}, {}});
    EXPECT_EQ(bad.violations, 1u);
    ASSERT_EQ(bad.witnesses.size(), 1u);
    EXPECT_EQ(bad.witnesses[0].front, 5u);
    EXPECT_EQ(bad.witnesses[0].back, 4u);
    expect_truth<std::int64_t>("ring of boards", mesh, {eye, {0, 0, -1, 0}, {6, 6, 40, 1}, {6, 6, 2, 1}}, true);
}

TEST(OrderChecker, CellsThatOverlapAreReportedApart)
{
    Random random(2);
    Mesh mesh;
    for (int i = 0; i < 12; ++i)
        add_random_cell(mesh, random, 0, 9);
    const Scene scene(mesh);
    std::vector<std::pair<CellId, CellId>> overlapping;
    for (const auto& [a, b] : scene.overlapping_cells()) {
        const CellId x = scene.caller_cells()[a], y = scene.caller_cells()[b];
        overlapping.emplace_back(std::min(x, y), std::max(x, y));
    }
    std::sort(overlapping.begin(), overlapping.end());
    ASSERT_FALSE(overlapping.empty());
    const OrderChecker checker(scene);
    for (const glm::dvec4& eye : small_scene_eyes(scene, 1)) {
        const CheckResult result = checker.check(eye, random_order(scene, random));
        EXPECT_EQ(result.overlapping, overlapping);
        checker.relations_at(eye).visit(
            [&](CellId front, CellId back) { EXPECT_FALSE(interiors_overlap(scene, front, back)); });
    }
}

TEST(OrderChecker, TrianglesOfASurfaceAreOrderedAmongThemselves)
{
    Mesh mesh;
    for (const double z : {0.0, 1.0, 2.0, 2.0})
        for (const glm::dvec3& p : {glm::dvec3(0, 0, z), glm::dvec3(4, 0, z), glm::dvec3(0, 4, z)})
            mesh.points.push_back(p);
    for (PointId i = 0; i < 4; ++i)
        mesh.add(CellShape::triangle, std::array<PointId, 3>{3 * i, 3 * i + 1, 3 * i + 2});
    mesh.points.insert(mesh.points.end(), {{1, 1, -1}, {1, 2, -1}, {2, 1, 0.5}}); // pierces the lowest
    mesh.add(CellShape::triangle, std::array<PointId, 3>{12, 13, 14});
    const Scene scene(mesh);
    const OrderChecker checker(scene);
    const CheckResult result = checker.check({1, 1, 9, 1}, {{0, 4, 1, 3, 2}, {}, {}});
    EXPECT_EQ(result.relations, 8u);
    EXPECT_EQ(result.violations, 0u);
    EXPECT_EQ(result.overlapping, (std::vector<std::pair<CellId, CellId>>{{0, 4}}));
    const CheckResult wrong = checker.check({0, 0, -1, 0}, {{0, 4, 1, 3, 2}, {}, {}});
    EXPECT_EQ(wrong.violations, 8u);
    EXPECT_EQ(wrong.witnesses.size(), 8u);
}

TEST(OrderChecker, WitnessesAreFiniteWhateverTheMagnitudes)
{
    const auto kinds = audit_kinds();
    const auto magnitudes = std::find_if(
        kinds.begin(), kinds.end(), [](const AuditKind& kind) { return kind.name == std::string_view("magnitudes"); });
    ASSERT_NE(magnitudes, kinds.end());
    std::size_t witnesses = 0;
    for (const std::uint64_t number : {1, 2, 3, 4, 7024}) {
        const AuditScene audited = magnitudes->scene(number);
        const Scene scene(audited.mesh);
        const OrderChecker checker(scene);
        Order order;
        order.back_to_front.resize(scene.cell_count());
        std::iota(order.back_to_front.begin(), order.back_to_front.end(), CellId{0});
        for (int turn = 0; turn < 2; ++turn) {
            std::reverse(order.back_to_front.begin(), order.back_to_front.end());
            for (auto i = static_cast<std::size_t>(turn); i < audited.eyes.size(); i += 3)
                for (const Violation& v : checker.check(audited.eyes[i], order).witnesses) {
                    ++witnesses;
                    EXPECT_TRUE(std::isfinite(v.witness.x) && std::isfinite(v.witness.y) && std::isfinite(v.witness.z))
                        << reproduce(fmt::format("magnitudes {}", number), audited.eyes[i]) << ", cells " << v.front
                        << " and " << v.back;
                }
        }
    }
    EXPECT_GT(witnesses, 20u);
}

TEST(OrderChecker, RejectsOrdersThatAreNoPermutation)
{
    const Scene scene(box_grid({1, 1, 3}, 1, 0, 2));
    const OrderChecker checker(scene);
    const auto fault = [&](const std::vector<CellId>& cells) -> std::string {
        try {
            checker.check({0, 0, 1, 0}, {cells, {}, {}});
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    };
    const CellId n = scene.cell_count();
    std::vector<CellId> cells(n);
    std::iota(cells.begin(), cells.end(), 0u);
    EXPECT_EQ(fault(cells), "");
    cells.back() = 0;
    EXPECT_EQ(fault(cells), "the order lists cell 0 twice");
    cells.back() = n;
    EXPECT_NE(fault(cells).find("cell " + std::to_string(n)), std::string::npos);
    cells.pop_back();
    EXPECT_EQ(fault(cells), "the order leaves out cell " + std::to_string(n - 1));
    cells.push_back(n - 1);
    cells.push_back(1);
    EXPECT_EQ(fault(cells), "the order lists cell 1 twice");
    EXPECT_EQ(fault({}), "the order leaves out cell 0");
}

TEST(OrderChecker, RejectsEyesAndScenesThatHaveNoOrder)
{
    const Scene scene(box_grid({1, 1, 2}, 1, 0, 1));
    const OrderChecker checker(scene);
    EXPECT_THROW(checker.relations_at(glm::dvec4(0)), InputError);
    EXPECT_THROW(checker.relations_at({0, 0, std::nan(""), 1}), InputError);
    EXPECT_THROW(checker.relations_at({0, 0, 1, std::numeric_limits<double>::infinity()}), InputError);

    Mesh bent = whole_boxes({1, 1, 1}, 1, 0, 1);
    bent.points[0].z -= 0.1;
    const Scene bent_scene(bent);
    EXPECT_THROW(OrderChecker{bent_scene}, InputError);
}

TEST(OrderChecker, ResultsDoNotDependOnThreads)
{
    const Scene scene(box_grid({7, 7, 7}, 2, 0.4, 8));
    Random random(3);
    const Order order = random_order(scene, random);
    for (const glm::dvec4& eye : {glm::dvec4(30, 20, 50, 1), glm::dvec4(6.5, 5.5, 4.5, 1), glm::dvec4(1, 2, 3, 0)}) {
        CheckResult one;
        {
            const oneapi::tbb::global_control single(oneapi::tbb::global_control::max_allowed_parallelism, 1);
            one = OrderChecker(scene).check(eye, order);
        }
        const CheckResult many = OrderChecker(scene).check(eye, order);
        EXPECT_EQ(one.relations, many.relations);
        EXPECT_EQ(one.violations, many.violations);
        EXPECT_EQ(one.unorderable, many.unorderable);
        ASSERT_EQ(one.witnesses.size(), 16u);
        ASSERT_EQ(many.witnesses.size(), 16u);
        for (std::size_t i = 0; i < 16; ++i) {
            EXPECT_EQ(one.witnesses[i].front, many.witnesses[i].front);
            EXPECT_EQ(one.witnesses[i].back, many.witnesses[i].back);
            EXPECT_EQ(one.witnesses[i].witness, many.witnesses[i].witness);
        }
    }
}

} // namespace
} // namespace visorder::tests
