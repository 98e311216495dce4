#pragma once

#include "geometry/exact_predicates.h"
#include "scene/adjacency.h"
#include "scene/face_planes.h"
#include "visorder/scene.h"
#include "visorder/sorter.h"

#include <glm/vec4.hpp>
#include <gtest/gtest.h>
#include <set>
#include <utility>
#include <vector>

namespace visorder::tests {

using namespace detail;

inline std::set<std::pair<CellId, CellId>> pairs_in(const std::vector<std::vector<CellId>>& sets)
{
    std::set<std::pair<CellId, CellId>> pairs;
    for (const auto& set : sets)
        for (CellId a : set)
            for (CellId b : set)
                pairs.emplace(a, b);
    return pairs;
}

/// Holds an order against every interior face, decided one by one.
inline void expect_interior_relations(const Scene& scene, const glm::dvec4& eye, const Order& order)
{
    std::vector<std::size_t> position(scene.cell_count(), scene.cell_count());
    for (std::size_t i = 0; i < order.back_to_front.size(); ++i)
        position[order.back_to_front[i]] = i;
    const auto in_cycle = pairs_in(order.cycles);
    const auto caller = scene.caller_cells();
    std::size_t wrong = 0;
    for (CellId cell = 0; cell < scene.cell_count(); ++cell) {
        ASSERT_LT(position[caller[cell]], scene.cell_count()) << "not listed: " << caller[cell];
        const auto row = scene.adjacency().row(cell);
        for (int f = 0; f < face_count(scene.mesh().shapes[cell]); ++f) {
            const CellId behind = row[static_cast<std::size_t>(f)];
            if (behind == cell || exact_face_side(scene, cell, f, eye) != Sign::negative)
                continue;
            wrong += position[caller[behind]] > position[caller[cell]] &&
                     in_cycle.count({caller[cell], caller[behind]}) == 0;
        }
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(order.back_to_front.size(), scene.cell_count());
}

} // namespace visorder::tests
