#include "expectations.h"

#include "brute_force.h"
#include "visorder/checking.h"

#include <cstdint>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace visorder::tests {

View view_from(const glm::dvec4& eye)
{
    return {eye, glm::dmat4(1), {64, 64}};
}

std::string reproduce(const std::string& scene, const glm::dvec4& eye)
{
    return fmt::format("{}, eye {}, {}, {}, {}", scene, eye.x, eye.y, eye.z, eye.w);
}

Order sorted(Sorter& sorter, const glm::dvec4& eye)
{
    Order order;
    sorter.sort(view_from(eye), order);
    return order;
}

double statistic(const Sorter& sorter, const std::string& name)
{
    for (const Statistic& s : sorter.statistics())
        if (name == s.name)
            return s.value;
    ADD_FAILURE() << "no statistic " << name;
    return 0;
}

std::vector<glm::dvec4> some_of(const std::vector<glm::dvec4>& eyes, std::size_t first, std::size_t stride)
{
    std::vector<glm::dvec4> chosen;
    for (std::size_t i = first % stride; i < eyes.size(); i += stride)
        chosen.push_back(eyes[i]);
    return chosen;
}

Order expect_right_order(const OrderChecker& checker, Sorter& sorter, const glm::dvec4& eye)
{
    Order order = sorted(sorter, eye);
    const CheckResult result = checker.check(eye, order);
    EXPECT_EQ(result.violations, 0u);
    for (const Violation& violation : result.witnesses)
        ADD_FAILURE() << "cell " << violation.front << " obstructs " << violation.back;
    EXPECT_EQ(result.unorderable, order.cycles);
    return order;
}

void expect_no_obstruction_violated(const Scene& scene, const glm::dvec4& eye, const Order& order)
{
    ASSERT_EQ(order.back_to_front.size(), scene.cell_count());
    std::vector<std::size_t> place(scene.cell_count(), 0), cycle(scene.cell_count(), 0);
    for (std::size_t i = 0; i < order.back_to_front.size(); ++i)
        place[order.back_to_front[i]] = i;
    for (std::size_t i = 0; i < order.cycles.size(); ++i)
        for (CellId cell : order.cycles[i])
            cycle[cell] = i + 1;
    const auto caller = scene.caller_cells();
    for (CellId a = 0; a < scene.cell_count(); ++a)
        for (CellId b = 0; b < scene.cell_count(); ++b) {
            if (a == b || place[caller[a]] > place[caller[b]] ||
                (cycle[caller[a]] != 0 && cycle[caller[a]] == cycle[caller[b]]))
                continue;
            EXPECT_FALSE(brute_force::obstructs<std::int64_t>(scene, a, b, eye))
                << "cell " << caller[a] << " obstructs " << caller[b];
        }
}

} // namespace visorder::tests
