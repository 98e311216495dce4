#include "sorting/cyclic_order.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

using Matrix = std::vector<std::vector<bool>>;

Matrix closure(std::uint32_t n, const std::vector<Precedence>& edges)
{
    Matrix reaches(n, std::vector<bool>(n));
    for (const Precedence& edge : edges)
        if (!edge.tentative)
            reaches[edge.before][edge.after] = true;
    for (std::uint32_t k = 0; k < n; ++k)
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j)
                reaches[i][j] = reaches[i][j] || (reaches[i][k] && reaches[k][j]);
    return reaches;
}

TEST(CyclicOrder, SatisfiesTentativeEdgesThatContradictNothing)
{
    const CyclicOrder order = order_with_cycles(3, std::vector<Precedence>{{2, 1, false}, {1, 0, true}});
    EXPECT_LT(order.level[2], order.level[1]);
    EXPECT_LT(order.level[1], order.level[0]);
    EXPECT_TRUE(order.cycles.empty());
}

TEST(CyclicOrder, GivesUpTentativeEdgesFirst)
{
    // 0, 1, 2, 3 in a row, and a tentative edge back.
    const CyclicOrder order =
        order_with_cycles(4, std::vector<Precedence>{{0, 1, false}, {3, 0, true}, {1, 2, false}, {2, 3, false}});
    EXPECT_EQ(order.level, (std::vector<std::uint32_t>{0, 1, 2, 3}));
    EXPECT_TRUE(order.cycles.empty());
    EXPECT_EQ(order.level_count, 4u);
}

TEST(CyclicOrder, ReportsCyclesOfFirmEdgesAlone)
{
    const std::vector<Precedence> edges{{0, 1, false}, {1, 2, false}, {2, 0, false}, {2, 3, false},
                                        {3, 4, true},  {4, 3, true},  {4, 1, true}};
    EXPECT_EQ(order_with_cycles(5, edges).cycles, (std::vector<std::vector<std::uint32_t>>{{0, 1, 2}}));
}

TEST(CyclicOrder, SatisfiesEveryFirmEdgeOutsideOfCycles)
{
    std::mt19937 engine(3);
    const auto below = [&](std::uint32_t count) { return static_cast<std::uint32_t>(engine() % count); };
    for (int trial = 0; trial < 3000; ++trial) {
        const std::uint32_t n = 2 + below(12);
        std::vector<Precedence> edges;
        for (std::uint32_t i = below(3 * n); i-- > 0;) {
            const std::uint32_t before = below(n), after = below(n);
            if (before != after)
                edges.push_back({before, after, below(3) == 0});
        }
        const Matrix reaches = closure(n, edges);
        const CyclicOrder order = order_with_cycles(n, edges);
        std::vector<std::uint32_t> in_cycle(n, 0);
        for (const auto& cycle : order.cycles)
            for (const std::uint32_t node : cycle)
                ++in_cycle[node];
        for (std::uint32_t i = 0; i < n; ++i) {
            ASSERT_LT(order.level[i], order.level_count) << "trial " << trial;
            ASSERT_EQ(in_cycle[i], reaches[i][i] ? 1u : 0u) << "trial " << trial;
        }
        // Also over chains: what runs through a cycle is satisfied before and behind it.
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j)
                if (reaches[i][j] && !reaches[j][i]) {
                    ASSERT_LT(order.level[i], order.level[j]) << "trial " << trial;
                }
    }
}

} // namespace
} // namespace visorder::tests
