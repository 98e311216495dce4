#include "visorder/checking.h"

#include "audit_scenes.h"
#include "checking/ray_sequence.h"
#include "expectations.h"
#include "sampled_rays.h"
#include "small_scenes.h"
#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <optional>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

using sampled_rays::Rational;

// Every cell's stretch of a ray, in rational arithmetic from its vertices alone.
std::vector<std::optional<std::pair<Rational, Rational>>> stretches(const Scene& scene, const glm::dvec4& eye,
                                                                    const glm::dvec3& through)
{
    const sampled_rays::Ray ray = sampled_rays::ray_through(eye.w < 0 ? -eye : eye, sampled_rays::vector_of(through));
    std::vector<std::optional<std::pair<Rational, Rational>>> all;
    for (CellId cell = 0; cell < scene.cell_count(); ++cell) {
        const auto vertices = sampled_rays::vertices_of(scene, cell);
        all.push_back(scene.is_surface() ? sampled_rays::point_in_triangle(vertices, ray)
                                         : sampled_rays::stretch_in_solid(sampled_rays::planes_of(vertices), ray));
    }
    return all;
}

void expect_sequence(const Scene& scene, const glm::dvec4& eye, const glm::dvec3& through, const RaySequence& sequence)
{
    const auto expected = stretches(scene, eye, through);
    ASSERT_EQ(sequence.cells.size(), sequence.behind.size());
    std::vector<CellId> cells = sequence.cells, passed;
    std::sort(cells.begin(), cells.end());
    for (CellId cell = 0; cell < scene.cell_count(); ++cell)
        if (expected[cell])
            passed.push_back(cell);
    ASSERT_EQ(cells, passed);
    for (std::size_t i = 0; i < sequence.cells.size(); ++i) {
        const auto& [enter, leave] = *expected[sequence.cells[i]];
        for (std::size_t j = i + 1; j < sequence.cells.size(); ++j) {
            const Rational& next = expected[sequence.cells[j]]->first;
            EXPECT_TRUE(enter <= next);
            EXPECT_EQ(j >= sequence.behind[i], scene.is_surface() ? leave < next : leave <= next);
        }
    }
}

TEST(RayTracer, PassesTheCellsThatRationalArithmeticFindsInTheirOrder)
{
    for (const AuditKind& kind : audit_kinds())
        for (std::uint64_t number = 1; number <= 2 && !HasFailure(); ++number) {
            const AuditScene audited = kind.scene(number);
            const Scene scene(audited.mesh);
            for (std::size_t i = number % 3; i < audited.eyes.size() && !HasFailure(); i += 3) {
                SCOPED_TRACE(reproduce(fmt::format("{} {}", kind.name, number), audited.eyes[i]));
                const RayAudit audit(scene, audited.eyes[i], {.rays = 12, .seed = number});
                for (std::size_t ray = 0; ray < audit.ray_count(); ++ray) {
                    SCOPED_TRACE(fmt::format("ray {}", ray));
                    expect_sequence(scene, audited.eyes[i], audit.through(ray), audit.sequence(ray));
                }
                // Along edges and through vertices.
                RaySequence sequence;
                const RayTracer tracer(scene, audited.eyes[i]);
                const auto& points = scene.mesh().points;
                for (std::size_t p = 0; p < points.size(); p += 1 + points.size() / 4) {
                    const glm::dvec4& e = audited.eyes[i];
                    if (points[p] * e.w == glm::dvec3(e))
                        continue;
                    tracer.trace(points[p], sequence);
                    expect_sequence(scene, e, points[p], sequence);
                }
            }
        }
}

TEST(RayAudit, AgreesWithTheDirectRelationsAndFindsMostOfThem)
{
    std::size_t relations = 0, seen = 0;
    for (const AuditKind& kind : audit_kinds())
        for (std::uint64_t number = 1; number <= 2; ++number) {
            const AuditScene audited = kind.scene(number);
            const Scene scene(audited.mesh);
            for (std::size_t i = number % 7; i < audited.eyes.size(); i += 7) {
                SCOPED_TRACE(reproduce(fmt::format("{} {}", kind.name, number), audited.eyes[i]));
                // An order that is wrong about nearly everything in one of its two directions.
                Order order;
                for (CellId cell = 0; cell < scene.cell_count(); ++cell)
                    order.back_to_front.push_back(cell);
                const DirectRelations direct(scene, audited.eyes[i]);
                const RayAudit audit(scene, audited.eyes[i], {.rays = 400});
                for (int direction = 0; direction < 2; ++direction) {
                    const CheckResult truth = direct.check(order, {1'000'000});
                    const RayAuditResult shown = audit.check(order, truth.unorderable, {1'000'000});
                    EXPECT_LE(shown.violations, truth.violations);
                    for (const Violation& violation : shown.witnesses)
                        EXPECT_TRUE(std::any_of(
                            truth.witnesses.begin(), truth.witnesses.end(),
                            [&](const Violation& v) { return v.front == violation.front && v.back == violation.back; }))
                            << violation.front << " " << violation.back;
                    relations += truth.violations;
                    seen += shown.violations;
                    std::reverse(order.back_to_front.begin(), order.back_to_front.end());
                }
            }
        }
    EXPECT_GT(10 * seen, 9 * relations);
}

TEST(RayAudit, FindsAWrongPairAndNamesAWitness)
{
    Mesh mesh;
    add_box(mesh, glm::dvec3(0), glm::dvec3(1));
    add_box(mesh, glm::dvec3(4, 0, 0), glm::dvec3(5, 1, 1));
    const Scene scene(mesh);
    const RayAudit audit(scene, {9, 0.5, 0.5, 1}, {.rays = 100});
    Order order;
    order.back_to_front = {1, 0};
    const RayAuditResult wrong = audit.check(order);
    EXPECT_EQ(wrong.rays, 100u);
    EXPECT_GT(wrong.pairs, 50u);
    EXPECT_EQ(wrong.violations, 1u);
    ASSERT_EQ(wrong.witnesses.size(), 1u);
    EXPECT_EQ(wrong.witnesses[0].front, 1u);
    EXPECT_EQ(wrong.witnesses[0].back, 0u);
    EXPECT_EQ(wrong.witnesses[0].witness.x, 1);
    order.back_to_front = {0, 1};
    EXPECT_EQ(audit.check(order).violations, 0u);
    EXPECT_EQ(audit.check(order).pairs, wrong.pairs);
}

TEST(RayAudit, ExemptsWhatRunsInCyclesByItsOwnRaysAndByWhatIsKnown)
{
    const Scene scene(interlocked_bars(true));
    Order order;
    order.back_to_front = {0, 1, 2};
    const RayAuditResult enough = RayAudit(scene, {0, 0, 1, 0}, {.rays = 1000}).check(order);
    EXPECT_EQ(enough.violations, 0u);
    EXPECT_GT(enough.violations_in_cycles, 0u);
    // Two bars alone make no cycle.
    Mesh two = interlocked_bars(true);
    two.shapes.pop_back();
    two.offsets.pop_back();
    two.vertices.resize(two.offsets.back());
    const Scene pair(two);
    const RayAudit audit(pair, {0, 0, 1, 0}, {.rays = 1000});
    std::size_t violations = 0;
    for (const auto& cells : {std::array<CellId, 2>{0, 1}, std::array<CellId, 2>{1, 0}}) {
        order.back_to_front.assign(cells.begin(), cells.end());
        violations += audit.check(order).violations;
        const std::array cycles{std::vector<CellId>{0, 1}};
        EXPECT_EQ(audit.check(order, cycles).violations, 0u);
    }
    EXPECT_EQ(violations, 1u);
}

TEST(RayAudit, DoesNotCountCellsThatOverlapAnywhere)
{
    // Two crossed beams: apart on most rays, either way round, and in each other in the middle.
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {9, 0, 9}, {0, 1, 0}, {9, 1, 9}, {0, 0, 1}, {9, 0, 10}, {0, 1, 1}, {9, 1, 10}};
    mesh.add(CellShape::hexahedron, std::array{0u, 1u, 3u, 2u, 4u, 5u, 7u, 6u});
    const auto first = static_cast<PointId>(mesh.points.size());
    for (PointId i = 0; i < first; ++i)
        mesh.points.push_back({mesh.points[i].x, mesh.points[i].y, 10 - mesh.points[i].z});
    mesh.add(CellShape::hexahedron, std::array{8u, 9u, 11u, 10u, 12u, 13u, 15u, 14u});
    const Scene scene(mesh);
    const RayAudit audit(scene, {0, 0, 1, 0}, {.rays = 400});
    for (const auto& cells : {std::array<CellId, 2>{0, 1}, std::array<CellId, 2>{1, 0}}) {
        Order order;
        order.back_to_front.assign(cells.begin(), cells.end());
        const RayAuditResult result = audit.check(order);
        EXPECT_GT(result.pairs, 100u);
        EXPECT_GT(result.overlapping_pairs, 0u);
        EXPECT_EQ(result.violations, 0u);
    }
}

TEST(RayAudit, DoesNotDependOnThreads)
{
    const Scene scene(box_grid({3, 3, 3}, 2, 0.3, 5));
    const auto audited = [&](std::size_t threads) {
        const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        const RayAudit audit(scene, {7, 5, 20, 1}, {.rays = 500, .seed = 3});
        std::vector<glm::dvec3> points;
        std::vector<std::vector<CellId>> cells;
        for (std::size_t ray = 0; ray < audit.ray_count(); ++ray) {
            points.push_back(audit.through(ray));
            cells.push_back(audit.sequence(ray).cells);
        }
        return std::pair(points, cells);
    };
    EXPECT_EQ(audited(1), audited(4));
}

TEST(RayAudit, RefusesWhatItCannotTake)
{
    Mesh mesh;
    add_box(mesh, glm::dvec3(0), glm::dvec3(1));
    const Scene scene(mesh);
    EXPECT_THROW(RayAudit(scene, {0, 0, 0, 0}), InputError);
    EXPECT_THROW((void)RayAudit(scene, {1, 2, 3, 1}).check(Order{{1}, {}, {}}), InputError);
    mesh.points[3].z = 0.5;
    const Scene warped(mesh);
    EXPECT_THROW(RayAudit(warped, {1, 2, 3, 1}), InputError);
}

} // namespace
} // namespace visorder::tests
