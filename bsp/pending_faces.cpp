#include "bsp/pending_faces.h"

#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

namespace visorder::detail {

void PendingFaces::Extent::add(const ImageBoxes::ImageBox& box)
{
    min = glm::min(min, glm::dvec3(box.min, box.nearest));
    max = glm::max(max, glm::dvec3(box.max, box.farthest));
    sizes += glm::dvec2(box.max) - glm::dvec2(box.min);
    ++count;
}

PendingFaces::Grid PendingFaces::grid(const Extent& extent, std::size_t first_list)
{
    Grid grid;
    grid.first_list = first_list;
    const auto set = [&](double low, double high, double numbers, auto&& take) {
        if (high > low)
            take(static_cast<float>(low),
                 static_cast<float>(
                     std::min(numbers / (high - low), static_cast<double>(std::numeric_limits<float>::max()))),
                 static_cast<float>(numbers - 1));
    };
    Scale& scale = grid.scale;
    const auto set_sides = [&](int axis) {
        return [&scale, axis](float origin, float per_unit, float most) {
            scale.origin[axis] = scale.origin[axis + 2] = origin;
            scale.per_unit[axis] = scale.per_unit[axis + 2] = per_unit;
            scale.most[axis] = scale.most[axis + 2] = most;
        };
    };
    // Squares three times as large as a face is on average.
    const auto squares = [&](double size, double of_faces) {
        return size > 0 ? static_cast<std::uint32_t>(std::clamp(0.3 * size * extent.count / of_faces, 1.0,
                                                                std::min(std::sqrt(4 * extent.count + 1), 65536.0)))
                        : 1;
    };
    grid.columns = squares(extent.max.x - extent.min.x, extent.sizes.x);
    grid.rows = squares(extent.max.y - extent.min.y, extent.sizes.y);
    // As many numbers a square as 16 bits allow.
    grid.column_shift = 16 - static_cast<int>(std::bit_width(grid.columns - 1));
    grid.row_shift = 16 - static_cast<int>(std::bit_width(grid.rows - 1));
    set(extent.min.x, extent.max.x, std::ldexp(grid.columns, grid.column_shift), set_sides(0));
    set(extent.min.y, extent.max.y, std::ldexp(grid.rows, grid.row_shift), set_sides(1));
    set(extent.min.z, extent.max.z, depth_steps, [&](float origin, float per_unit, float most) {
        scale.depth_origin = origin;
        scale.depth_per_unit = per_unit;
        scale.depth_most = most;
    });
    return grid;
}

// Lists the faces of one chart.
void PendingFaces::fill(const Grid& grid)
{
    lists_.resize(grid.first_list + 1 + std::size_t{grid.columns} * grid.rows);
    std::array<std::uint32_t, depth_steps> places{}; // of the faces of a depth
    const auto step = [](const Entry& entry) { return entry.most_minus_farthest - (0x10000 - depth_steps); };
    for (const Entry& entry : faces_) {
        ++places[step(entry)];
        each_list(grid, entry, [&](std::size_t list) { ++lists_[list].end; });
    }
    std::uint32_t place = 0;
    for (std::uint32_t& of_depth : places)
        place += std::exchange(of_depth, place);
    by_depth_.resize(faces_.size());
    for (std::uint32_t i = 0; i < faces_.size(); ++i)
        by_depth_[places[step(faces_[i])]++] = i;

    auto end = static_cast<std::uint32_t>(entries_.size());
    for (std::size_t i = grid.first_list; i < lists_.size(); ++i) {
        lists_[i].begin = end;
        end += std::exchange(lists_[i].end, end);
    }
    entries_.resize(end);
    for (std::uint32_t i : by_depth_)
        each_list(grid, faces_[i], [&](std::size_t list) { entries_[lists_[list].end++] = faces_[i]; });
}

std::size_t PendingFaces::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return size_of(grids_) + size_of(lists_) + size_of(entries_) + size_of(is_pending_) + size_of(present_) +
           size_of(faces_) + size_of(by_depth_);
}

} // namespace visorder::detail
