#include "bsp/pending_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

ImageBoxes::ImageBox ImageBoxes::bounds(int chart) const
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    ImageBox all{glm::vec3(infinity), glm::vec3(-infinity)};
    for (std::size_t i = static_cast<std::size_t>(chart); i < boxes_.size(); i += static_cast<std::size_t>(charts_)) {
        all.min = glm::vec3(std::min(all.min.x, boxes_[i].min.x), std::min(all.min.y, boxes_[i].min.y),
                            std::min(all.min.z, boxes_[i].min.z));
        all.max = glm::vec3(std::max(all.max.x, boxes_[i].max.x), std::max(all.max.y, boxes_[i].max.y),
                            std::max(all.max.z, boxes_[i].max.z));
    }
    return all;
}

void PendingFaces::reset(const ImageBoxes& boxes, std::size_t faces)
{
    boxes_ = &boxes;
    grids_.assign(static_cast<std::size_t>(boxes.chart_count()), {});
    std::size_t heads = 0;
    for (int chart = 0; chart < boxes.chart_count(); ++chart) {
        const ImageBoxes::ImageBox bounds = boxes.bounds(chart);
        Grid& grid = grids_[static_cast<std::size_t>(chart)];
        grid.first_head = heads;
        const float width = bounds.max.x - bounds.min.x, height = bounds.max.y - bounds.min.y;
        if (width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height)) {
            // Squares, about as many as faces.
            const float squares = static_cast<float>(std::max<std::size_t>(faces, 1));
            const auto count = [](float n) { return static_cast<std::uint32_t>(std::clamp(n, 1.0f, 2048.0f)); };
            grid.columns = count(std::sqrt(squares * width / height));
            grid.rows = count(std::sqrt(squares * height / width));
            grid.origin = {bounds.min.x, bounds.min.y};
            grid.per_unit = {static_cast<float>(grid.columns) / width, static_cast<float>(grid.rows) / height};
        }
        heads += 1 + std::size_t{grid.columns} * grid.rows;
    }
    heads_.assign(heads, none);
    links_.clear();
    stamps_.assign(faces, 0);
    search_ = 0;
}

void PendingFaces::add(std::uint32_t face)
{
    for (int chart = 0; chart < boxes_->chart_count(); ++chart) {
        if (!boxes_->present(face, chart))
            continue;
        const ImageBoxes::ImageBox& box = boxes_->box(face, chart);
        const Grid& grid = grids_[static_cast<std::size_t>(chart)];
        const auto put = [&](std::size_t head) {
            links_.push_back({face, heads_[head]});
            heads_[head] = static_cast<std::uint32_t>(links_.size() - 1);
        };
        if (square_count(grid, box) > most_squares)
            put(grid.first_head);
        else
            each_square(grid, box, put);
    }
}

std::size_t PendingFaces::bytes() const
{
    return grids_.capacity() * sizeof(Grid) + (heads_.capacity() + stamps_.capacity()) * sizeof(std::uint32_t) +
           links_.capacity() * sizeof(Link);
}

} // namespace visorder
