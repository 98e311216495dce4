#include "orders_of_relations.h"

#include "small_scenes.h"
#include "sorting/strongly_connected.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace visorder::tests {

using namespace detail;

Order random_order(const Scene& scene, const Relations& relations, bool satisfy, std::uint64_t seed)
{
    const CellId cells = scene.cell_count();
    std::vector<std::uint32_t> from, to;
    if (satisfy)
        relations.visit([&](CellId front, CellId back) {
            from.push_back(front);
            to.push_back(back);
        });
    const std::vector<std::uint32_t> set_of = strongly_connected_components(graph_of(cells, from, to)).of_node;
    std::vector<std::size_t> waits_for(cells, 0);
    std::vector<std::vector<CellId>> fronts(cells);
    for (std::size_t i = 0; i < from.size(); ++i)
        if (set_of[from[i]] != set_of[to[i]]) {
            ++waits_for[from[i]];
            fronts[to[i]].push_back(from[i]);
        }
    std::vector<CellId> free;
    for (CellId cell = 0; cell < cells; ++cell)
        if (waits_for[cell] == 0)
            free.push_back(cell);
    Order order;
    Random random(seed);
    while (!free.empty()) {
        std::swap(free[static_cast<std::size_t>(random.below(static_cast<int>(free.size())))], free.back());
        const CellId cell = free.back();
        free.pop_back();
        order.back_to_front.push_back(scene.caller_cells()[cell]);
        for (CellId front : fronts[cell])
            if (--waits_for[front] == 0)
                free.push_back(front);
    }
    return order;
}

} // namespace visorder::tests
