#include "sorting/strongly_connected.h"

#include <gtest/gtest.h>
#include <random>

namespace visorder::tests {

using namespace detail;
namespace {

TEST(StronglyConnected, AreTheSetsThatReachEachOther)
{
    std::mt19937_64 random(3);
    for (int trial = 0; trial < 300; ++trial) {
        const auto n = static_cast<std::uint32_t>(1 + random() % 12);
        std::vector<std::uint32_t> from, to;
        std::vector<std::vector<bool>> reaches(n, std::vector<bool>(n, false));
        for (std::uint64_t e = random() % (3 * n); e > 0; --e) {
            from.push_back(static_cast<std::uint32_t>(random() % n));
            to.push_back(static_cast<std::uint32_t>(random() % n));
            reaches[from.back()][to.back()] = true;
        }
        for (std::uint32_t k = 0; k < n; ++k)
            for (std::uint32_t i = 0; i < n; ++i)
                for (std::uint32_t j = 0; j < n; ++j)
                    reaches[i][j] = reaches[i][j] || (reaches[i][k] && reaches[k][j]);
        const Components components = strongly_connected_components(graph_of(n, from, to));
        for (std::uint32_t i = 0; i < n; ++i)
            for (std::uint32_t j = 0; j < n; ++j) {
                const bool together = i == j || (reaches[i][j] && reaches[j][i]);
                ASSERT_EQ(components.of_node[i] == components.of_node[j], together) << "trial " << trial;
                if (reaches[i][j] && !together) {
                    ASSERT_GT(components.of_node[i], components.of_node[j]) << "trial " << trial;
                }
            }
    }
}

TEST(StronglyConnected, TakesLongPathsWithoutRecursion)
{
    const std::uint32_t n = 1'000'000;
    std::vector<std::uint32_t> from(n), to(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        from[i] = i;
        to[i] = (i + 1) % n;
    }
    EXPECT_EQ(strongly_connected_components(graph_of(n, from, to)).count, 1u);
}

} // namespace
} // namespace visorder::tests
