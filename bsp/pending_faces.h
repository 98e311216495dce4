#pragma once

#include "scene/box.h"
#include "sorting/projection_charts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
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

/// Entry faces that the walk of a BSP tree has come to before their cells could be listed, by where they are in the
/// image: a grid over each chart. The faces of cells that have been listed meanwhile are dropped as they are met.
class PendingFaces {
public:
    /// None, with grids for about `faces` of them. `boxes` must live as long as these are asked for.
    void reset(const ImageBoxes& boxes, std::size_t faces);
    /// Adds a face of boundary cell `cell`. Drops what it meets of cells for which is_listed(boundary cell).
    template <class IsListed>
    void add(std::uint32_t face, std::uint32_t cell, IsListed&& is_listed);

    /// Calls visit(pending face) once for each that face `face` may cover, until it returns false: their boxes meet,
    /// and not all of the pending face is nearer. Drops those of cells for which is_listed(boundary
    /// cell).
    template <class IsListed, class Visit>
    void search(std::uint32_t face, IsListed&& is_listed, Visit&& visit);

    std::size_t bytes() const;

private:
    static constexpr std::uint32_t none = 0xffffffffu;
    // A face over more squares of the grid than this is kept apart, in a list that all searches go through.
    static constexpr std::uint32_t most_squares = 64;

    // Of a list in which faces stand by their farthest points, farthest first.
    struct Link {
        glm::vec2 min, max;
        float farthest;
        std::uint32_t face;
        std::uint32_t cell;
        std::uint32_t next;
    };
    struct Grid {
        std::uint32_t columns = 1, rows = 1;
        glm::vec2 origin{}, per_unit{};
        std::size_t first_head = 0; // of the list of faces too large for the grid; those of its squares follow

        std::uint32_t column(float x) const { return at((x - origin.x) * per_unit.x, columns); }
        std::uint32_t row(float y) const { return at((y - origin.y) * per_unit.y, rows); }
        static std::uint32_t at(float place, std::uint32_t count)
        {
            return place >= static_cast<float>(count) ? count - 1 : place > 0 ? static_cast<std::uint32_t>(place) : 0;
        }
    };

    template <class Visit>
    void each_square(const Grid& grid, const ImageBoxes::ImageBox& box, Visit&& visit) const
    {
        const std::uint32_t left = grid.column(box.min.x), right = grid.column(box.max.x);
        const std::uint32_t low = grid.row(box.min.y), high = grid.row(box.max.y);
        for (std::uint32_t y = low; y <= high; ++y)
            for (std::uint32_t x = left; x <= right; ++x)
                visit(grid.first_head + 1 + std::size_t{y} * grid.columns + x);
    }
    std::size_t square_count(const Grid& grid, const ImageBoxes::ImageBox& box) const
    {
        return std::size_t{grid.column(box.max.x) - grid.column(box.min.x) + 1} *
               (grid.row(box.max.y) - grid.row(box.min.y) + 1);
    }

    const ImageBoxes* boxes_ = nullptr;
    std::vector<Grid> grids_; // a chart
    std::vector<std::uint32_t> heads_;
    std::vector<Link> links_;
    std::vector<std::uint32_t> stamps_; // a face: the search that saw it last
    std::uint32_t search_ = 0;
};

template <class IsListed>
void PendingFaces::add(std::uint32_t face, std::uint32_t cell, IsListed&& is_listed)
{
    for (int chart = 0; chart < boxes_->chart_count(); ++chart) {
        if (!boxes_->present(face, chart))
            continue;
        const ImageBoxes::ImageBox& box = boxes_->box(face, chart);
        const Grid& grid = grids_[static_cast<std::size_t>(chart)];
        const auto put = [&](std::size_t head) {
            std::uint32_t* at = &heads_[head];
            while (*at != none) {
                Link& link = links_[*at];
                if (is_listed(link.cell)) {
                    *at = link.next;
                    continue;
                }
                if (link.farthest <= box.max.z)
                    break;
                at = &link.next;
            }
            const std::uint32_t next = *at;
            *at = static_cast<std::uint32_t>(links_.size());
            links_.push_back({glm::vec2(box.min), glm::vec2(box.max), box.max.z, face, cell, next});
        };
        if (square_count(grid, box) > most_squares)
            put(grid.first_head);
        else
            each_square(grid, box, put);
    }
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
        const auto look_through = [&](std::size_t head) {
            std::uint32_t* at = &heads_[head];
            while (go_on && *at != none) {
                Link& link = links_[*at];
                if (link.farthest < box.min.z)
                    return;
                if (is_listed(link.cell)) {
                    *at = link.next;
                    continue;
                }
                at = &link.next;
                if (link.max.x < box.min.x || box.max.x < link.min.x || link.max.y < box.min.y ||
                    box.max.y < link.min.y || stamps_[link.face] == search_)
                    continue;
                stamps_[link.face] = search_;
                go_on = visit(link.face);
            }
        };
        look_through(grid.first_head);
        each_square(grid, box, look_through);
        if (!go_on)
            return;
    }
}

} // namespace visorder
