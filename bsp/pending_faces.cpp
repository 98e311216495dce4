#include "bsp/pending_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder {

void ImageBoxes::reset(std::size_t faces, int charts)
{
    charts_ = charts;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    boxes_.assign(faces * static_cast<std::size_t>(charts), {glm::vec3(infinity), glm::vec3(-infinity)});
}

void ImageBoxes::set(std::size_t face, int chart, const Box& box)
{
    constexpr double most = std::numeric_limits<float>::max();
    const auto rounded = [&](const glm::dvec3& v) {
        return glm::vec3(std::clamp(v.x, -most, most), std::clamp(v.y, -most, most), std::clamp(v.z, -most, most));
    };
    boxes_[face * static_cast<std::size_t>(charts_) + static_cast<std::size_t>(chart)] = {rounded(box.min),
                                                                                          rounded(box.max)};
}

void PendingFaces::make_grids(std::size_t faces)
{
    const ImageBoxes& boxes = *boxes_;
    grids_.assign(static_cast<std::size_t>(boxes.chart_count()), {});
    std::size_t lists = 0;
    for (int chart = 0; chart < boxes.chart_count(); ++chart) {
        glm::dvec2 min(std::numeric_limits<double>::infinity()), max = -min, sizes(0);
        double count = 0;
        for (std::size_t face = 0; face < faces; ++face) {
            if (!boxes.present(face, chart))
                continue;
            const ImageBoxes::ImageBox& box = boxes.box(face, chart);
            const glm::dvec2 low(box.min), high(box.max);
            min = {std::min(min.x, low.x), std::min(min.y, low.y)};
            max = {std::max(max.x, high.x), std::max(max.y, high.y)};
            sizes += high - low;
            ++count;
        }
        Grid& grid = grids_[static_cast<std::size_t>(chart)];
        grid.first_list = lists;
        const glm::dvec2 size = max - min;
        if (count > 0 && size.x > 0 && size.y > 0) {
            // Squares twice as large as a face is on average.
            const auto squares = [&](double extent, double of_faces) {
                return static_cast<std::uint32_t>(
                    std::clamp(0.5 * extent * count / of_faces, 1.0, std::sqrt(4 * count + 1)));
            };
            grid.columns = squares(size.x, sizes.x);
            grid.rows = squares(size.y, sizes.y);
            grid.origin = glm::vec2(min);
            grid.per_unit = glm::vec2(glm::dvec2(grid.columns, grid.rows) / size);
        }
        lists += 1 + std::size_t{grid.columns} * grid.rows;
    }
    lists_.assign(lists, {});
}

void PendingFaces::sort_lists()
{
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, lists_.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            std::sort(entries_.begin() + lists_[i].begin, entries_.begin() + lists_[i].end,
                      [](const Entry& a, const Entry& b) {
                          return a.farthest > b.farthest || (a.farthest == b.farthest && a.face < b.face);
                      });
    });
}

std::size_t PendingFaces::bytes() const
{
    return grids_.capacity() * sizeof(Grid) + lists_.capacity() * sizeof(List) + entries_.capacity() * sizeof(Entry) +
           is_added_.capacity() + stamps_.capacity() * sizeof(std::uint32_t);
}

} // namespace visorder
