#include "parallel/team.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

// Members write in turn what all read after the barrier; a barrier that lets one through early shows as a wrong sum.
void expect_in_step(std::size_t most)
{
    std::vector<std::size_t> written;
    Team::run(most, [&](Team& team, std::size_t member) {
        if (member == 0)
            written.assign(team.size(), 0);
        team.wait_for_all();
        for (std::size_t round = 1; round <= 2000; ++round) {
            written[member] = round;
            team.wait_for_all();
            for (std::size_t value : written)
                ASSERT_EQ(value, round);
            team.wait_for_all();
        }
    });
}

TEST(Team, KeepsItsMembersInStep)
{
    for (std::size_t most : {1u, 2u, 3u, 4u})
        expect_in_step(most);
}

TEST(Team, WorksAloneWhereNobodyElseCanCome)
{
    oneapi::tbb::task_arena one(1);
    one.execute([] {
        Team::run(4, [](Team& team, std::size_t member) {
            EXPECT_EQ(team.size(), 1u);
            EXPECT_EQ(member, 0u);
        });
    });
}

TEST(Team, WorksWithinParallelWork)
{
    oneapi::tbb::parallel_for(0, 8, [](int) { expect_in_step(2); });
}

} // namespace
} // namespace visorder::tests
