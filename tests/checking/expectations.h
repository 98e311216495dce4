#pragma once

#include "visorder/scene.h"
#include "visorder/sorter.h"

#include <cstddef>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

namespace visorder {
class OrderChecker;
}

namespace visorder::tests {

// What the tests of all exact sorters expect of them.

View view_from(const glm::dvec4& eye);

/// In words: the scene and the eye.
std::string reproduce(const std::string& scene, const glm::dvec4& eye);

Order sorted(Sorter& sorter, const glm::dvec4& eye);

/// Fails the test where there is none of this name.
double statistic(const Sorter& sorter, const std::string& name);

/// Every `stride`-th of the eyes.
std::vector<glm::dvec4> some_of(const std::vector<glm::dvec4>& eyes, std::size_t first, std::size_t stride);

/// Sorts: no relation may be violated, and the cycles must be the sets that no order can satisfy.
Order expect_right_order(const OrderChecker& checker, Sorter& sorter, const glm::dvec4& eye);

/// Holds an order against what obstruction means, for every pair of cells. For scenes and eyes with small integer
/// coordinates, and without flat cells or overlapping ones.
void expect_no_obstruction_violated(const Scene& scene, const glm::dvec4& eye, const Order& order);

} // namespace visorder::tests
