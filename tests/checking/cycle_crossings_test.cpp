#include "audit_scenes.h"
#include "expectations.h"
#include "orders_of_relations.h"
#include "visorder/checking.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

namespace visorder::tests {
namespace {

const AuditKind& kind_of(const std::string& name)
{
    const auto kinds = audit_kinds();
    return *std::find_if(kinds.begin(), kinds.end(), [&](const AuditKind& kind) { return name == kind.name; });
}

bool is_relation(const Scene& scene, const DirectRelations& direct, const Violation& violation)
{
    const auto caller = scene.caller_cells();
    return std::any_of(direct.relations().begin(), direct.relations().end(), [&](const Relation& r) {
        return caller[r.front] == violation.front && caller[r.back] == violation.back;
    });
}

// Orders that satisfy every relation outside of cycles, so that what is wrong is wrong across them.
TEST(CycleCrossings, MakeWrongWhatTheDirectRelationsSayIs)
{
    std::size_t wrong = 0, across = 0;
    for (std::uint64_t number = 1; number <= 10; ++number) {
        const AuditScene audited = kind_of("bars").scene(number);
        const Scene scene(audited.mesh);
        const OrderChecker checker(scene);
        // The last eyes are those from which bars occlude each other in a cycle.
        for (std::size_t i = audited.eyes.size() - 3; i < audited.eyes.size(); ++i) {
            const glm::dvec4& eye = audited.eyes[i];
            const Relations relations = checker.relations_at(eye);
            const DirectRelations direct(scene, eye);
            for (std::uint64_t seed = 1; seed <= 4; ++seed) {
                SCOPED_TRACE(reproduce(fmt::format("bars {}, order {}", number, seed), eye));
                const Order order = random_order(scene, relations, true, seed);
                const CheckResult said = checker.check(relations, order, {3});
                const CheckResult truth = direct.check(order, {0});
                EXPECT_EQ(said.violations, said.violations_across_cycles);
                EXPECT_LE(said.violations, truth.violations);
                EXPECT_EQ(said.violations > 0, truth.violations > 0);
                EXPECT_EQ(said.unorderable, truth.unorderable);
                for (const Violation& v : said.witnesses)
                    EXPECT_TRUE(is_relation(scene, direct, v)) << v.front << " " << v.back;
                wrong += truth.violations;
                across += said.violations_across_cycles;
            }
        }
    }
    EXPECT_GT(wrong, 0u);
    EXPECT_GT(across, 0u);
}

} // namespace
} // namespace visorder::tests
