#pragma once

#include "scene/box.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
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

    std::size_t face_count() const { return faces_; }
    int chart_count() const { return charts_; }
    /// Absent where min.x > max.x.
    const ImageBox& box(std::size_t face, int chart) const
    {
        return boxes_[face * static_cast<std::size_t>(charts_) + static_cast<std::size_t>(chart)];
    }
    bool present(std::size_t face, int chart) const { return box(face, chart).min.x <= box(face, chart).max.x; }
    std::size_t bytes() const { return boxes_.capacity() * sizeof(ImageBox); }

private:
    std::size_t faces_ = 0;
    int charts_ = 0;
    std::vector<ImageBox> boxes_;
};

/// Entry faces by where they are in the image, to find those that an exit face may cover: a grid over each chart, whose
/// squares list their faces farthest first. A face is found from the time when the walk of the BSP tree comes to it
/// (`add`) until its cell is listed (`remove`).
///
/// Boxes are kept in 16-bit numbers, to which single precision is mapped without changing its order: what meets there
/// meets here.
class PendingFaces {
public:
    /// Takes the faces with is_entry(face), none of them added. `boxes` must live as long as these are asked for.
    template <class IsEntry>
    void reset(const ImageBoxes& boxes, IsEntry&& is_entry);

    /// Returns whether the face was neither added nor removed before.
    bool add(std::uint32_t face)
    {
        const bool first = states_[face] == to_come;
        states_[face] = first ? pending : states_[face];
        return first;
    }
    void remove(std::uint32_t face) { states_[face] = gone; }

    /// Calls visit(face) for each added one that face `face` may cover and that is not removed, once a chart at most,
    /// until it returns false: their boxes meet, and not all of the entry face is nearer. Some time before that, it
    /// calls prepare(face).
    template <class Prepare, class Visit>
    void search(std::uint32_t face, Prepare&& prepare, Visit&& visit);

    std::size_t bytes() const;

private:
    // A face over more squares of the grid than this is kept apart, in a list that all searches go through.
    static constexpr std::size_t most_squares = 64;
    // Entries of a list that searches look at before those that are gone are taken out.
    static constexpr std::uint32_t looks_between_cleanings = 64;
    static constexpr std::size_t found_at_once = 16;

    static constexpr std::uint8_t to_come = 0;
    static constexpr std::uint8_t pending = 1;
    static constexpr std::uint8_t gone = 2;

    using Number = std::uint16_t;

    // From single precision to numbers, along one axis.
    struct Scale {
        float origin = 0;
        float per_unit = 0;
        float most = 0;

        Number number(float x) const
        {
            const float place = (x - origin) * per_unit;
            return static_cast<Number>(place >= most ? most : place > 0 ? place : 0.0f);
        }
    };
    struct Entry {
        Number left, low, right, high;
        Number farthest;
        std::uint32_t face;

        bool meets(const Entry& other) const
        {
            // All four at once: which one fails is as good as random.
            return ((left <= other.right) & (other.left <= right) & (low <= other.high) & (other.low <= high)) != 0;
        }
    };
    struct Grid {
        std::uint32_t columns = 1, rows = 1;
        int column_shift = 0, row_shift = 0; // from numbers to squares
        Scale x, y, depth;
        std::size_t first_list = 0; // of the faces too large for the grid; those of its squares follow

        Entry entry(const ImageBoxes::ImageBox& box, std::uint32_t face) const
        {
            return {x.number(box.min.x), y.number(box.min.y),     x.number(box.max.x),
                    y.number(box.max.y), depth.number(box.max.z), face};
        }
        std::uint32_t column(Number number) const { return std::uint32_t{number} >> column_shift; }
        std::uint32_t row(Number number) const { return std::uint32_t{number} >> row_shift; }
        std::size_t list(std::uint32_t column, std::uint32_t row) const
        {
            return first_list + 1 + std::size_t{row} * columns + column;
        }
    };
    struct List {
        std::uint32_t begin = 0; // in entries_; moves as faces are gone
        std::uint32_t end = 0;
        std::uint32_t looks = 0;
    };
    // Of the faces in one chart.
    struct Extent {
        glm::dvec3 min{std::numeric_limits<double>::infinity()};
        glm::dvec3 max{-std::numeric_limits<double>::infinity()};
        glm::dvec2 sizes{0}; // the sum of all
        double count = 0;

        void add(const ImageBoxes::ImageBox& box);
    };

    static Grid grid(const Extent& extent, std::size_t first_list);
    void fill(const Grid& grid);
    void clean(List& list, std::uint32_t end);

    // The lists that a face is in.
    template <class Visit>
    static void each_list(const Grid& grid, const Entry& entry, Visit&& visit)
    {
        const std::uint32_t left = grid.column(entry.left), right = grid.column(entry.right);
        const std::uint32_t low = grid.row(entry.low), high = grid.row(entry.high);
        if (std::size_t{right - left + 1} * (high - low + 1) > most_squares) {
            visit(grid.first_list);
            return;
        }
        for (std::uint32_t row = low; row <= high; ++row)
            for (std::uint32_t column = left; column <= right; ++column)
                visit(grid.list(column, row));
    }

    // Looks through one list for what meets `sought` and is not all nearer than `nearest`, if is_here(entry).
    template <class IsHere, class Prepare, class Visit>
    bool look_through(List& list, const Entry& sought, Number nearest, IsHere&& is_here, Prepare&& prepare,
                      Visit&& visit);

    const ImageBoxes* boxes_ = nullptr;
    std::vector<Grid> grids_; // a chart
    std::vector<List> lists_;
    std::vector<Entry> entries_;
    std::vector<std::uint8_t> states_; // a face

    // Of one chart, while it is filled.
    std::vector<Entry> faces_;
    std::vector<std::uint32_t> farthest_first_; // in faces_
};

template <class IsEntry>
void PendingFaces::reset(const ImageBoxes& boxes, IsEntry&& is_entry)
{
    boxes_ = &boxes;
    grids_.clear();
    lists_.clear();
    entries_.clear();
    const auto count = static_cast<std::uint32_t>(boxes.face_count());
    for (int chart = 0; chart < boxes.chart_count(); ++chart) {
        Extent extent;
        for (std::uint32_t face = 0; face < count; ++face)
            if (is_entry(face) && boxes.present(face, chart))
                extent.add(boxes.box(face, chart));
        const Grid& of_chart = grids_.emplace_back(grid(extent, lists_.size()));
        faces_.clear();
        for (std::uint32_t face = 0; face < count; ++face)
            if (is_entry(face) && boxes.present(face, chart))
                faces_.push_back(of_chart.entry(boxes.box(face, chart), face));
        fill(of_chart);
    }
    states_.assign(count, to_come);
}

template <class IsHere, class Prepare, class Visit>
bool PendingFaces::look_through(List& list, const Entry& sought, Number nearest, IsHere&& is_here, Prepare&& prepare,
                                Visit&& visit)
{
    while (list.begin < list.end && states_[entries_[list.begin].face] == gone)
        ++list.begin;
    std::uint32_t at = list.begin;
    while (at < list.end && entries_[at].farthest >= nearest) {
        std::array<std::uint32_t, found_at_once> found;
        std::size_t count = 0;
        for (; at < list.end && entries_[at].farthest >= nearest && count < found_at_once; ++at) {
            const Entry& entry = entries_[at];
            if (entry.meets(sought) && is_here(entry) && states_[entry.face] == pending) {
                prepare(entry.face);
                found[count++] = entry.face;
            }
        }
        for (std::size_t i = 0; i < count; ++i)
            if (!visit(found[i]))
                return false;
    }
    list.looks += at - list.begin;
    if (list.looks >= looks_between_cleanings)
        clean(list, at);
    return true;
}

template <class Prepare, class Visit>
void PendingFaces::search(std::uint32_t face, Prepare&& prepare, Visit&& visit)
{
    for (int chart = 0; chart < boxes_->chart_count(); ++chart) {
        if (!boxes_->present(face, chart))
            continue;
        const Grid& grid = grids_[static_cast<std::size_t>(chart)];
        const ImageBoxes::ImageBox& box = boxes_->box(face, chart);
        const Entry sought = grid.entry(box, face);
        const Number nearest = grid.depth.number(box.min.z);
        const auto anywhere = [](const Entry&) { return true; };
        if (!look_through(lists_[grid.first_list], sought, nearest, anywhere, prepare, visit))
            return;
        const std::uint32_t left = grid.column(sought.left), right = grid.column(sought.right);
        const std::uint32_t low = grid.row(sought.low), high = grid.row(sought.high);
        for (std::uint32_t row = low; row <= high; ++row)
            for (std::uint32_t column = left; column <= right; ++column) {
                // Of the squares that both are in, in the first.
                const auto first_here = [&](const Entry& entry) {
                    return std::max(left, grid.column(entry.left)) == column &&
                           std::max(low, grid.row(entry.low)) == row;
                };
                if (!look_through(lists_[grid.list(column, row)], sought, nearest, first_here, prepare, visit))
                    return;
            }
    }
}

} // namespace visorder
