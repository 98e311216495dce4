#include "parallel/team.h"

#include "parallel/concurrency.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <memory>
#include <oneapi/tbb/task_group.h>
#include <thread>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace visorder::detail {

namespace {

void pause_briefly()
{
#if defined(__SSE2__)
    _mm_pause();
#endif
}

constexpr auto patience = std::chrono::microseconds(200); // for members to arrive: a sleeping worker wakes within this
constexpr int spins_before_yield = 1 << 12;

// Arrivals, and the gate that closes on latecomers.
struct Muster {
    static constexpr std::size_t closed = std::size_t{1} << 32;

    std::atomic<std::size_t> arrived{1}; // member 0 is there; `closed` is added when the gate closes
    std::atomic<bool> started{false};

    // The member's number, or 0 if it came too late.
    std::size_t arrive()
    {
        std::size_t n = arrived.load(std::memory_order_relaxed);
        while (n < closed)
            if (arrived.compare_exchange_weak(n, n + 1, std::memory_order_acq_rel))
                return n;
        return 0;
    }
};

} // namespace

void Team::run(std::size_t most, const std::function<void(Team&, std::size_t)>& work)
{
    Team team;
    most = std::min(most, concurrency());
    if (most <= 1) {
        work(team, 0);
        return;
    }
    Muster muster;
    oneapi::tbb::task_group group;
    for (std::size_t i = 1; i < most; ++i)
        group.run([&] {
            const std::size_t member = muster.arrive();
            if (member == 0)
                return;
            while (!muster.started.load(std::memory_order_acquire))
                pause_briefly();
            if (member < team.size_)
                work(team, member);
        });
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (muster.arrived.load(std::memory_order_relaxed) < most && std::chrono::steady_clock::now() < deadline)
        pause_briefly();
    const std::size_t arrived = muster.arrived.fetch_add(Muster::closed, std::memory_order_acq_rel);
    // A power of two, so that work is divided among members by a few bits of its number.
    team.size_ = std::bit_floor(arrived);
    muster.started.store(true, std::memory_order_release);
    work(team, 0);
    group.wait();
}

void Team::wait_for_all()
{
    if (size_ == 1)
        return;
    const std::size_t round = round_.load(std::memory_order_relaxed);
    if (waiting_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
        waiting_.store(0, std::memory_order_relaxed);
        round_.store(round + 1, std::memory_order_release);
        return;
    }
    for (int spins = 0; round_.load(std::memory_order_acquire) == round; ++spins) {
        if (spins < spins_before_yield)
            pause_briefly();
        else
            std::this_thread::yield();
    }
}

} // namespace visorder::detail
