#include "checking/order_positions.h"

#include "visorder/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

LargeArray<std::uint32_t> order_positions(const Scene& scene, const Order& order)
{
    constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
    const CellId cells = scene.cell_count();
    LargeArray<std::uint32_t> of_caller(cells);
    std::fill(of_caller.begin(), of_caller.end(), nowhere);
    for (std::size_t i = 0; i < order.back_to_front.size(); ++i) {
        const CellId cell = order.back_to_front[i];
        if (cell >= cells)
            throw InputError(fmt::format("the order lists cell {}, but the scene has {} cells", cell, cells));
        if (of_caller[cell] != nowhere)
            throw InputError(fmt::format("the order lists cell {} twice", cell));
        of_caller[cell] = static_cast<std::uint32_t>(i);
    }
    if (order.back_to_front.size() < cells) {
        const auto missing = std::find(of_caller.begin(), of_caller.end(), nowhere);
        throw InputError(fmt::format("the order leaves out cell {}", missing - of_caller.begin()));
    }
    LargeArray<std::uint32_t> positions(cells);
    const auto caller = scene.caller_cells();
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<CellId>(0, cells, 16384), [&](const auto& range) {
        for (CellId cell = range.begin(); cell < range.end(); ++cell)
            positions[cell] = of_caller[caller[cell]];
    });
    return positions;
}

} // namespace visorder::detail
