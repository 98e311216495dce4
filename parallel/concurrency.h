#pragma once

#include <algorithm>
#include <cstddef>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace visorder::detail {

/// How many threads may work for the caller: those of its TBB arena, within what the program allows in all.
inline std::size_t concurrency()
{
    using oneapi::tbb::global_control;
    return std::min(static_cast<std::size_t>(oneapi::tbb::this_task_arena::max_concurrency()),
                    global_control::active_value(global_control::max_allowed_parallelism));
}

} // namespace visorder::detail
