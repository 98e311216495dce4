#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace visorder::detail {

/// A few threads that work through many short steps side by side, held together by a spinning barrier: thousands of
/// levels a frame leave no time for a scheduler. Members come from the TBB arena of the caller. Whoever has not arrived
/// when the work starts is not waited for, so a team of one is always possible and none can deadlock.
class Team {
public:
    /// Runs `work(team, member)` on up to `most` threads, of which the caller is member 0, and returns when all have
    /// finished. `size` is the same for all of them. `work` must not throw once there is more than one member.
    static void run(std::size_t most, const std::function<void(Team&, std::size_t member)>& work);

    std::size_t size() const { return size_; }

    /// Returns when all members have called it as often as the caller.
    void wait_for_all();

private:
    std::size_t size_ = 1;
    alignas(64) std::atomic<std::size_t> waiting_{0};
    alignas(64) std::atomic<std::size_t> round_{0};
};

} // namespace visorder::detail
