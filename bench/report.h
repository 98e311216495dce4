#pragma once

#include "bench/comparison.h"

#include <string>

namespace visorder::bench {

/// What the figures were measured on.
struct Machine {
    std::string cpu;
    int threads;
    std::string gl_renderer; ///< "none" where there is no OpenGL
};
Machine this_machine();

/// The comparison as a table, a line a sorter and scene: times are medians over views, counts are sums. `colour` marks
/// broken guarantees in red for a terminal; `statistics` adds those of each sorter, as medians over views.
std::string table(const Comparison& comparison, bool colour, bool statistics);

/// The comparison in the project's result format: every run of every view. What was not measured is null.
std::string json(const Comparison& comparison, const Machine& machine);

} // namespace visorder::bench
