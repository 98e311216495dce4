#pragma once

#include <chrono>

namespace visorder::detail {

/// Wall-clock seconds since it was made, or since the last lap.
class Stopwatch {
public:
    double lap()
    {
        const auto now = std::chrono::steady_clock::now();
        const std::chrono::duration<double> passed = now - begin_;
        begin_ = now;
        return passed.count();
    }

private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

} // namespace visorder::detail
