#pragma once

#include "scene/box.h"
#include "sorting/projection_charts.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

namespace visorder {

/// The boxes of faces in the charts of one eye, in single precision. Rounding keeps the order of numbers, so boxes that
/// meet in double precision meet here.
class ImageBoxes {
public:
    struct ImageBox {
        glm::vec3 min, max;
    };

    /// Makes room for `faces` faces in `charts` charts; all are absent.
    void reset(std::size_t faces, int charts);
    /// Any number of threads may set different faces.
    void set(std::size_t face, int chart, const Box& box);

    int chart_count() const { return charts_; }
    /// Absent where min.x > max.x.
    const ImageBox& box(std::size_t face, int chart) const
    {
        return boxes_[face * static_cast<std::size_t>(charts_) + static_cast<std::size_t>(chart)];
    }
    bool present(std::size_t face, int chart) const { return box(face, chart).min.x <= box(face, chart).max.x; }
    std::size_t bytes() const { return boxes_.capacity() * sizeof(ImageBox); }

private:
    int charts_ = 0;
    std::vector<ImageBox> boxes_;
};

/// Entry faces by where they are in the image, to find those that an exit face may cover: a grid over each chart, whose
/// squares list their faces farthest first. A face is found from the time when the walk of the BSP tree comes to it
/// (`add`) until its cell is listed.
class PendingFaces {
public:
    /// Takes the faces with is_entry(face), none of them added; `cells` are the boundary cells of all faces. `boxes`
    /// must live as long as these are asked for.
    template <class IsEntry>
    void reset(const ImageBoxes& boxes, std::span<const std::uint32_t> cells, IsEntry&& is_entry);
    void add(std::uint32_t face) { is_added_[face] = 1; }

    /// Calls visit(face) once for each added one that face `face` may cover and whose cell is not listed, by
    /// is_listed(boundary cell), until it returns false: their boxes meet, and not all of the entry face is nearer.
    template <class IsListed, class Visit>
    void search(std::uint32_t face, IsListed&& is_listed, Visit&& visit);

    std::size_t bytes() const;

private:
    // A face over more squares of the grid than this is kept apart, in a list that all searches go through.
    static constexpr std::size_t most_squares = 64;

    struct Entry {
        glm::vec2 min, max;
        float farthest;
        std::uint32_t face;
        std::uint32_t cell;
    };
    struct Grid {
        std::uint32_t columns = 1, rows = 1;
        glm::vec2 origin{}, per_unit{};
        std::size_t first_list = 0; // of the faces too large for the grid; those of its squares follow

        std::uint32_t column(float x) const { return at((x - origin.x) * per_unit.x, columns); }
        std::uint32_t row(float y) const { return at((y - origin.y) * per_unit.y, rows); }
        static std::uint32_t at(float place, std::uint32_t count)
        {
            return place >= static_cast<float>(count) ? count - 1 : place > 0 ? static_cast<std::uint32_t>(place) : 0;
        }
    };
    struct List {
        std::uint32_t begin = 0; // in entries_; moves past those whose cells are listed
        std::uint32_t end = 0;
    };

    void make_grids(std::size_t faces);
    void sort_lists();

    template <class Visit>
    void each_square(const Grid& grid, const ImageBoxes::ImageBox& box, Visit&& visit) const
    {
        const std::uint32_t left = grid.column(box.min.x), right = grid.column(box.max.x);
        const std::uint32_t low = grid.row(box.min.y), high = grid.row(box.max.y);
        for (std::uint32_t y = low; y <= high; ++y)
            for (std::uint32_t x = left; x <= right; ++x)
                visit(grid.first_list + 1 + std::size_t{y} * grid.columns + x);
    }
    // The lists that a face is in.
    template <class Visit>
    void each_list(const Grid& grid, const ImageBoxes::ImageBox& box, Visit&& visit) const
    {
        const std::size_t squares = std::size_t{grid.column(box.max.x) - grid.column(box.min.x) + 1} *
                                    (grid.row(box.max.y) - grid.row(box.min.y) + 1);
        if (squares > most_squares)
            visit(grid.first_list);
        else
            each_square(grid, box, visit);
    }

    const ImageBoxes* boxes_ = nullptr;
    std::vector<Grid> grids_; // a chart
    std::vector<List> lists_;
    std::vector<Entry> entries_;
    std::vector<std::uint8_t> is_added_; // a face
    std::vector<std::uint32_t> stamps_;  // a face: the search that saw it last
    std::uint32_t search_ = 0;
};

template <class IsEntry>
void PendingFaces::reset(const ImageBoxes& boxes, std::span<const std::uint32_t> cells, IsEntry&& is_entry)
{
    boxes_ = &boxes;
    make_grids(cells.size());
    const auto each_entry = [&](auto&& visit) {
        for (int chart = 0; chart < boxes.chart_count(); ++chart)
            for (std::uint32_t face = 0; face < cells.size(); ++face)
                if (boxes.present(face, chart) && is_entry(face))
                    visit(face, grids_[static_cast<std::size_t>(chart)], boxes.box(face, chart));
    };
    each_entry([&](std::uint32_t, const Grid& grid, const ImageBoxes::ImageBox& box) {
        each_list(grid, box, [&](std::size_t list) { ++lists_[list].end; });
    });
    std::uint32_t end = 0;
    for (List& list : lists_) {
        list.begin = end;
        end += std::exchange(list.end, end);
    }
    entries_.resize(end);
    each_entry([&](std::uint32_t face, const Grid& grid, const ImageBoxes::ImageBox& box) {
        each_list(grid, box, [&](std::size_t list) {
            entries_[lists_[list].end++] = {glm::vec2(box.min), glm::vec2(box.max), box.max.z, face, cells[face]};
        });
    });
    sort_lists();
    is_added_.assign(cells.size(), 0);
    stamps_.assign(cells.size(), 0);
    search_ = 0;
}

template <class IsListed, class Visit>
void PendingFaces::search(std::uint32_t face, IsListed&& is_listed, Visit&& visit)
{
    ++search_;
    for (int chart = 0; chart < boxes_->chart_count(); ++chart) {
        if (!boxes_->present(face, chart))
            continue;
        const ImageBoxes::ImageBox& box = boxes_->box(face, chart);
        const Grid& grid = grids_[static_cast<std::size_t>(chart)];
        bool go_on = true;
        const auto look_through = [&](std::size_t index) {
            List& list = lists_[index];
            while (list.begin < list.end && is_listed(entries_[list.begin].cell))
                ++list.begin;
            for (std::uint32_t i = list.begin; go_on && i < list.end; ++i) {
                const Entry& entry = entries_[i];
                if (entry.farthest < box.min.z)
                    return;
                if (entry.max.x < box.min.x || box.max.x < entry.min.x || entry.max.y < box.min.y ||
                    box.max.y < entry.min.y || stamps_[entry.face] == search_)
                    continue;
                stamps_[entry.face] = search_;
                if (is_added_[entry.face] != 0 && !is_listed(entry.cell))
                    go_on = visit(entry.face);
            }
        };
        look_through(grid.first_list);
        each_square(grid, box, look_through);
        if (!go_on)
            return;
    }
}

} // namespace visorder
