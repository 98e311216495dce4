#include "bsp/pending_faces.h"

#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

namespace visorder {

namespace {

constexpr std::size_t depth_steps = 4096;

} // namespace

void ImageBoxes::reset(std::size_t faces, int charts)
{
    faces_ = faces;
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

void PendingFaces::Extent::add(const ImageBoxes::ImageBox& box)
{
    min = glm::min(min, glm::dvec3(box.min));
    max = glm::max(max, glm::dvec3(box.max));
    sizes += glm::dvec2(box.max) - glm::dvec2(box.min);
    ++count;
}

PendingFaces::Grid PendingFaces::grid(const Extent& extent, std::size_t first_list)
{
    Grid grid;
    grid.first_list = first_list;
    const auto set = [&](Scale& scale, double low, double high, double numbers) {
        if (!(high > low))
            return;
        scale.origin = static_cast<float>(low);
        scale.per_unit = static_cast<float>(
            std::min(numbers / (high - low), static_cast<double>(std::numeric_limits<float>::max())));
        scale.most = static_cast<float>(numbers - 1);
    };
    // Squares twice as large as a face is on average.
    const auto squares = [&](double size, double of_faces) {
        return size > 0 ? static_cast<std::uint32_t>(std::clamp(0.5 * size * extent.count / of_faces, 1.0,
                                                                std::min(std::sqrt(4 * extent.count + 1), 65536.0)))
                        : 1;
    };
    grid.columns = squares(extent.max.x - extent.min.x, extent.sizes.x);
    grid.rows = squares(extent.max.y - extent.min.y, extent.sizes.y);
    // As many numbers a square as 16 bits allow.
    grid.column_shift = 16 - static_cast<int>(std::bit_width(grid.columns - 1));
    grid.row_shift = 16 - static_cast<int>(std::bit_width(grid.rows - 1));
    set(grid.x, extent.min.x, extent.max.x, std::ldexp(grid.columns, grid.column_shift));
    set(grid.y, extent.min.y, extent.max.y, std::ldexp(grid.rows, grid.row_shift));
    set(grid.depth, extent.min.z, extent.max.z, depth_steps);
    return grid;
}

// Lists the faces of one chart.
void PendingFaces::fill(const Grid& grid)
{
    lists_.resize(grid.first_list + 1 + std::size_t{grid.columns} * grid.rows);
    std::array<std::uint32_t, rank_count> places{}; // of the faces of a rank
    for (const Entry& entry : faces_) {
        ++places[entry.first_rank >> rank_shift];
        each_list(grid, entry, [&](std::size_t list) { ++lists_[list].end; });
    }
    std::uint32_t place = 0;
    for (std::uint32_t& of_rank : places)
        place += std::exchange(of_rank, place);
    by_rank_.resize(faces_.size());
    for (std::uint32_t i = 0; i < faces_.size(); ++i)
        by_rank_[places[faces_[i].first_rank >> rank_shift]++] = i;

    auto end = static_cast<std::uint32_t>(entries_.size());
    for (std::size_t i = grid.first_list; i < lists_.size(); ++i) {
        lists_[i].begin = end;
        end += std::exchange(lists_[i].end, end);
    }
    entries_.resize(end);
    for (std::uint32_t i : by_rank_)
        each_list(grid, faces_[i], [&](std::size_t list) { entries_[lists_[list].end++] = faces_[i]; });
}

std::size_t PendingFaces::bytes() const
{
    const auto size_of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return size_of(grids_) + size_of(lists_) + size_of(entries_) + size_of(is_gone_) + size_of(sought_) +
           size_of(faces_) + size_of(by_rank_);
}

} // namespace visorder
