#include "visorder/checking.h"

#include "audit_scenes.h"
#include "brute_force.h"
#include "checking/convex_body.h"
#include "expectations.h"
#include "sampled_rays.h"
#include "scene/orientations.h"
#include "small_scenes.h"
#include "visorder/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

bool has(const DirectRelations& relations, CellId front, CellId back)
{
    const auto all = relations.relations();
    return std::binary_search(all.begin(), all.end(), Relation{front, back});
}

bool is_solid(const Scene& scene, CellId cell)
{
    return scene.orientations().sign[cell] != 0;
}

TEST(DirectRelations, AreThoseOfTheDefinitionOnSmallScenes)
{
    for (std::uint64_t number = 1; number <= 60 && !HasFailure(); ++number) {
        const Scene scene(small_scene(number));
        for (const glm::dvec4& eye : some_of(small_scene_eyes(scene, number), number, 5)) {
            SCOPED_TRACE(reproduce(fmt::format("small scene {}", number), eye));
            const DirectRelations direct(scene, eye);
            for (CellId a = 0; a < scene.cell_count(); ++a)
                for (CellId b = 0; b < scene.cell_count(); ++b) {
                    if (a == b)
                        continue;
                    EXPECT_EQ(has(direct, a, b), brute_force::obstructs<std::int64_t>(scene, a, b, eye))
                        << a << " " << b;
                }
        }
    }
}

// A ray that passes one cell before another is a relation, and a pair of both kinds of rays has none. Of the
// relations that no ray of the sample shows, some are narrow, but not most.
TEST(DirectRelations, HoldOnEveryRayOfASampleOfEveryKindOfScene)
{
    std::size_t relations = 0, seen = 0;
    for (const AuditKind& kind : audit_kinds())
        for (std::uint64_t number = 1; number <= 2; ++number) {
            const AuditScene audited = kind.scene(number);
            const Scene scene(audited.mesh);
            const CellId cells = std::min<CellId>(scene.cell_count(), 8);
            for (std::size_t i = number % 4; i < audited.eyes.size(); i += 4) {
                const glm::dvec4 eye = audited.eyes[i].w < 0 ? -audited.eyes[i] : audited.eyes[i];
                SCOPED_TRACE(reproduce(fmt::format("{} {}", kind.name, number), eye));
                const DirectRelations direct(scene, eye);
                for (CellId a = 0; a < cells; ++a)
                    for (CellId b = a + 1; b < cells; ++b) {
                        const auto [a_first, b_first] = sampled_rays::occlusions(scene, a, b, eye, 3);
                        EXPECT_TRUE(!a_first || !has(direct, b, a)) << a << " " << b;
                        EXPECT_TRUE(!b_first || !has(direct, a, b)) << a << " " << b;
                        if (a_first != b_first) {
                            // They may cross elsewhere.
                            const bool overlap = !has(direct, a, b) && !has(direct, b, a);
                            EXPECT_TRUE(!overlap || scene.is_surface() || brute_force::interiors_overlap(scene, a, b))
                                << a << " " << b;
                        }
                        relations += has(direct, a, b) || has(direct, b, a);
                        seen += (has(direct, a, b) && a_first) || (has(direct, b, a) && b_first);
                    }
            }
        }
    EXPECT_GT(relations, 1000u);
    EXPECT_GT(2 * seen, relations);
}

// Pairs are found by boxes, which must not lose any: of the scene 7024, coordinates are up to 1e297 along one axis and
// 1e-117 along another, and components of the axes along which its boxes lie underflow.
TEST(DirectRelations, TryEveryPairOfWhichOneOccludesTheOther)
{
    for (const AuditKind& kind : audit_kinds())
        for (const std::uint64_t number : {3, 7024}) {
            const AuditScene audited = kind.scene(number);
            const Scene scene(audited.mesh);
            if (scene.cell_count() > 30)
                continue;
            for (std::size_t i = 0; i < audited.eyes.size() && !HasFailure(); i += 2) {
                const glm::dvec4 eye = audited.eyes[i].w < 0 ? -audited.eyes[i] : audited.eyes[i];
                SCOPED_TRACE(reproduce(fmt::format("{} {}", kind.name, number), eye));
                const DirectRelations direct(scene, eye);
                for (CellId a = 0; a < scene.cell_count(); ++a)
                    for (CellId b = a + 1; b < scene.cell_count(); ++b) {
                        if (!can_occlude(scene.mesh(), a, eye) || !can_occlude(scene.mesh(), b, eye))
                            continue;
                        const ConvexBody of_a = body_of(scene.mesh(), a), of_b = body_of(scene.mesh(), b);
                        const bool a_first = occludes(of_a, of_b, eye), b_first = occludes(of_b, of_a, eye);
                        EXPECT_EQ(has(direct, a, b), a_first && !b_first) << a << " " << b;
                        EXPECT_EQ(has(direct, b, a), b_first && !a_first) << b << " " << a;
                    }
            }
        }
}

TEST(DirectRelations, OfSolidsWithoutOrderAreThoseOfCellsThatOverlap)
{
    for (std::uint64_t number = 1; number <= 20 && !HasFailure(); ++number) {
        const Scene scene(overlapping_cells(8, 6, number));
        Order order;
        for (CellId cell = 0; cell < scene.cell_count(); ++cell)
            order.back_to_front.push_back(cell);
        std::vector<std::pair<CellId, CellId>> expected;
        const auto caller = scene.caller_cells();
        for (CellId a = 0; a < scene.cell_count(); ++a)
            for (CellId b = a + 1; b < scene.cell_count(); ++b)
                if (is_solid(scene, a) && is_solid(scene, b) && brute_force::interiors_overlap(scene, a, b))
                    expected.push_back(std::minmax(caller[a], caller[b]));
        std::sort(expected.begin(), expected.end());
        for (const glm::dvec4& eye : small_scene_eyes(scene, number)) {
            SCOPED_TRACE(reproduce(fmt::format("overlapping cells {}", number), eye));
            EXPECT_EQ(DirectRelations(scene, eye).check(order).overlapping, expected);
        }
    }
}

TEST(DirectRelations, NameAWitnessOnARayThroughBoth)
{
    // The box at 0 is before the one at 4, from +x.
    Mesh mesh;
    add_box(mesh, glm::dvec3(0), glm::dvec3(1));
    add_box(mesh, glm::dvec3(4, 0, 0), glm::dvec3(5, 1, 1));
    const Scene scene(mesh);
    Order order;
    order.back_to_front = {1, 0};
    for (const glm::dvec4& eye : {glm::dvec4(9, 0.5, 0.5, 1), glm::dvec4(1, 0, 0, 0), glm::dvec4(-18, -1, -1, -2)}) {
        const CheckResult result = DirectRelations(scene, eye).check(order);
        ASSERT_EQ(result.violations, 1u);
        ASSERT_EQ(result.witnesses.size(), 1u);
        EXPECT_EQ(result.witnesses[0].front, 1u);
        EXPECT_EQ(result.witnesses[0].back, 0u);
        EXPECT_EQ(result.witnesses[0].witness.x, 1);
    }
    order.back_to_front = {0, 1};
    EXPECT_EQ(DirectRelations(scene, {9, 0.5, 0.5, 1}).check(order).violations, 0u);
    EXPECT_EQ(DirectRelations(scene, {-9, 0.5, 0.5, 1}).check(order).violations, 1u);
    // Between the two, neither occludes the other.
    EXPECT_EQ(DirectRelations(scene, {2, 0.5, 0.5, 1}).check(order).relations, 0u);
}

TEST(DirectRelations, OfTheCellThatTheEyeIsInAreWithAllOthers)
{
    Mesh mesh;
    for (int i = 0; i < 5; ++i)
        add_box(mesh, glm::dvec3(2 * i, i % 2, 0), glm::dvec3(2 * i + 1, i % 2 + 1, 1));
    const Scene scene(mesh);
    Order order;
    order.back_to_front = {2, 0, 1, 3, 4};
    const CheckResult result = DirectRelations(scene, {4.5, 0.5, 0.5, 1}).check(order);
    EXPECT_EQ(result.violations, 4u);
    EXPECT_EQ(result.witnesses.front().front, 2u);
}

TEST(DirectRelations, WithinACycleAreNoViolations)
{
    const Scene scene(interlocked_bars(true));
    Order order;
    order.back_to_front = {0, 1, 2};
    const CheckResult result = DirectRelations(scene, {0, 0, 1, 0}).check(order);
    EXPECT_EQ(result.violations, 0u);
    EXPECT_GT(result.violations_in_cycles, 0u);
    EXPECT_EQ(result.unorderable, (std::vector<std::vector<CellId>>{{0, 1, 2}}));
}

TEST(DirectRelations, RefuseWhatTheyCannotTake)
{
    Mesh mesh;
    add_box(mesh, glm::dvec3(0), glm::dvec3(1));
    add_box(mesh, glm::dvec3(2), glm::dvec3(3));
    const Scene scene(mesh);
    EXPECT_THROW(DirectRelations(scene, {1, 2, 3, 1}, {.max_cells = 1}), InputError);
    EXPECT_THROW(DirectRelations(scene, {0, 0, 0, 0}), InputError);
    EXPECT_THROW((void)DirectRelations(scene, {1, 2, 3, 1}).check(Order{{0, 0}, {}, {}}), InputError);
    mesh.points[3].z = 0.5;
    const Scene warped(mesh);
    EXPECT_THROW(DirectRelations(warped, {1, 2, 3, 1}), InputError);
}

} // namespace
} // namespace visorder::tests
