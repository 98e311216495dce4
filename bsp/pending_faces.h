#pragma once

#include "bsp/image_boxes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <span>
#include <vector>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace visorder::detail {

/// Entry faces by where they are in the image and in the walk of a BSP tree, to find those that an exit face may cover:
/// a grid over each chart, whose squares list their faces farthest first, which is about how they are removed. A face
/// is pending until its cell is listed.
///
/// Boxes are kept in 16-bit numbers, to which single precision is mapped without changing its order: what meets there
/// meets here.
class PendingFaces {
public:
    /// Takes the faces with is_entry(face) that are in some chart, all of them pending, and makes ready to search by
    /// any other. `boxes` must live, unchanged, as long as that goes on.
    template <class IsEntry>
    void reset(const ImageBoxes& boxes, IsEntry&& is_entry);

    /// The face's cell has been listed.
    void remove(std::uint32_t face) { is_pending_[face / 64] &= ~(std::uint64_t{1} << face % 64); }
    bool is_pending(std::uint32_t face) const { return (is_pending_[face / 64] >> face % 64 & 1) != 0; }

    /// Faces that were found; keeps its memory when it is cleared.
    class Found {
    public:
        void clear() { count_ = 0; }
        std::span<std::uint32_t> faces() { return {faces_.data(), count_}; }
        std::size_t bytes() const { return faces_.capacity() * sizeof(std::uint32_t); }

    private:
        friend class PendingFaces;
        std::vector<std::uint32_t> faces_;
        std::size_t count_ = 0;
    };

    /// Adds to `found` each pending one that face `face` may cover, once per chart at most: their boxes meet, not all
    /// of the entry face is nearer, and the walk came to it before it left `face`. Any number of threads may search
    /// side by side.
    void search(std::uint32_t face, Found& found);

    std::size_t bytes() const;

private:
    // A face over more squares of the grid than this is kept apart, in a list that all searches go through.
    static constexpr std::size_t most_squares = 64;

    using Number = std::uint16_t;
    static constexpr Number most = 0xffff;
    static constexpr std::size_t depth_steps = 4096;

    // From single precision to numbers: of the two sides of a box along x and y, and of a depth.
    struct Scale {
        glm::vec4 origin{0}, per_unit{0}, most{0};
        float depth_origin = 0, depth_per_unit = 0, depth_most = 0;

        std::array<Number, 4> sides(const ImageBoxes::ImageBox& box) const
        {
            const glm::vec4 place = (glm::vec4(box.min, box.max) - origin) * per_unit;
            std::array<Number, 4> numbers;
            for (int i = 0; i < 4; ++i)
                numbers[static_cast<std::size_t>(i)] = number(place[i], most[i]);
            return numbers;
        }
        Number depth(float z) const { return number((z - depth_origin) * depth_per_unit, depth_most); }

    private:
        // By way of the largest integers: those of 16 bits have no conversion of their own.
        static Number number(float place, float most)
        {
            place = place < most ? place : most;
            place = place > 0 ? place : 0.0f;
            return static_cast<Number>(static_cast<int>(place));
        }
    };
    // Four sides, a distance and a rank, all so turned that an upper bound can be asked for; see Query.
    struct alignas(16) Entry {
        Number left, low, most_minus_right, most_minus_high;
        Number most_minus_farthest;
        Number first_rank;
        std::uint32_t face;

        Number right() const { return static_cast<Number>(most - most_minus_right); }
        Number high() const { return static_cast<Number>(most - most_minus_high); }
    };
    // What entries of a list are asked for: their first six numbers less `from`, modulo 2^16, are to be at most
    // `up_to`. Four numbers are in one, the first lowest.
    struct Query {
        std::uint64_t from;
        std::array<std::uint64_t, 2> up_to;
        Number most_minus_farthest; // as lists are ordered

        bool holds(const Entry& entry) const;
    };
    // A face that may cover others.
    struct Sought {
        Number left, low, right, high;
        Number nearest;
        Number last_rank;
    };
    struct Grid {
        std::uint32_t columns = 1, rows = 1;
        int column_shift = 0, row_shift = 0; // from numbers to squares
        Scale scale;
        std::size_t first_list = 0; // of the faces too large for the grid; those of its squares follow

        Entry entry(const ImageBoxes::ImageBox& box, std::uint32_t face) const
        {
            const auto from_most = [](Number number) { return static_cast<Number>(most - number); };
            const auto [left, low, right, high] = scale.sides(box);
            return {left, low, from_most(right), from_most(high), from_most(scale.depth(box.farthest)), box.ranks.first,
                    face};
        }
        Sought sought(const ImageBoxes::ImageBox& box) const
        {
            const auto [left, low, right, high] = scale.sides(box);
            return {left, low, right, high, scale.depth(box.nearest), box.ranks.last};
        }
        // Of the squares that two faces are both in, only the first counts: that where one of them begins.
        Query query(const Sought& by, std::uint32_t at_column, std::uint32_t at_row) const
        {
            const auto begin = [](std::uint32_t square, int shift, bool first) {
                return first ? Number{0} : static_cast<Number>(square << shift);
            };
            const auto four = [](unsigned a, unsigned b, unsigned c, unsigned d) {
                return std::uint64_t{c | d << 16} << 32 | (a | b << 16);
            };
            const Number left = begin(at_column, column_shift, at_column == column(by.left));
            const Number low = begin(at_row, row_shift, at_row == row(by.low));
            return {four(left, low, 0, 0),
                    {four(static_cast<Number>(by.right - left), static_cast<Number>(by.high - low),
                          static_cast<Number>(most - by.left), static_cast<Number>(most - by.low)),
                     four(static_cast<Number>(most - by.nearest), by.last_rank, most, most)},
                    static_cast<Number>(most - by.nearest)};
        }
        std::uint32_t column(Number number) const { return std::uint32_t{number} >> column_shift; }
        std::uint32_t row(Number number) const { return std::uint32_t{number} >> row_shift; }
        std::size_t list(std::uint32_t column, std::uint32_t row) const
        {
            return first_list + 1 + std::size_t{row} * columns + column;
        }
    };
    struct List {
        std::uint32_t begin = 0; // in entries_; searches move it on where faces are gone
        std::uint32_t end = 0;
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

    // The lists that a face is in.
    template <class Visit>
    static void each_list(const Grid& grid, const Entry& entry, Visit&& visit)
    {
        const std::uint32_t left = grid.column(entry.left), right = grid.column(entry.right());
        const std::uint32_t low = grid.row(entry.low), high = grid.row(entry.high());
        if (std::size_t{right - left + 1} * (high - low + 1) > most_squares) {
            visit(grid.first_list);
            return;
        }
        for (std::uint32_t row = low; row <= high; ++row)
            for (std::uint32_t column = left; column <= right; ++column)
                visit(grid.list(column, row));
    }

    void look_through(List& list, const Query& query, Found& found) const;

    std::vector<Grid> grids_; // a chart
    std::vector<List> lists_;
    std::vector<Entry> entries_;
    std::vector<std::uint64_t> is_pending_; // bits, a face each
    const ImageBoxes* boxes_ = nullptr;

    // Of one chart, while it is filled.
    std::vector<std::uint32_t> present_;
    std::vector<Entry> faces_;
    std::vector<std::uint32_t> by_depth_; // in faces_, farthest first
};

#if defined(__SSE2__)
inline bool PendingFaces::Query::holds(const Entry& entry) const
{
    const auto numbers = [](std::uint64_t low, std::uint64_t high) {
        return _mm_set_epi64x(static_cast<long long>(high), static_cast<long long>(low));
    };
    const __m128i less = _mm_sub_epi16(_mm_load_si128(reinterpret_cast<const __m128i*>(&entry)), numbers(from, 0));
    const __m128i beyond = _mm_subs_epu16(less, numbers(up_to[0], up_to[1]));
    return _mm_movemask_epi8(_mm_cmpeq_epi16(beyond, _mm_setzero_si128())) == 0xffff;
}
#else
inline bool PendingFaces::Query::holds(const Entry& entry) const
{
    const std::array<Number, 6> numbers{
        entry.left,      entry.low, entry.most_minus_right, entry.most_minus_high, entry.most_minus_farthest,
        entry.first_rank};
    bool hold = true;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto bound = static_cast<Number>(up_to[i / 4] >> i % 4 * 16);
        const auto less = static_cast<Number>(i < 2 ? numbers[i] - (from >> i * 16) : numbers[i]);
        hold = hold & (less <= bound);
    }
    return hold;
}
#endif

template <class IsEntry>
void PendingFaces::reset(const ImageBoxes& boxes, IsEntry&& is_entry)
{
    grids_.clear();
    lists_.clear();
    entries_.clear();
    const auto count = static_cast<std::uint32_t>(boxes.face_count());
    boxes_ = &boxes;
    is_pending_.assign((count + 63) / 64, 0);
    for (int chart = 0; chart < boxes.chart_count(); ++chart) {
        const auto box = [&](std::uint32_t face) -> const ImageBoxes::ImageBox& { return boxes.box(face, chart); };
        Extent extent;
        present_.clear();
        for (std::uint32_t face = 0; face < count; ++face)
            if (is_entry(face) && box(face).present()) {
                present_.push_back(face);
                extent.add(box(face));
                is_pending_[face / 64] |= std::uint64_t{1} << face % 64;
            }
        const Grid& of_chart = grids_.emplace_back(grid(extent, lists_.size()));
        faces_.clear();
        for (const std::uint32_t face : present_)
            faces_.push_back(of_chart.entry(box(face), face));
        fill(of_chart);
    }
}

inline void PendingFaces::look_through(List& list, const Query& query, Found& found) const
{
    // A hint that threads need not agree on.
    const std::atomic_ref<std::uint32_t> moving_begin(list.begin);
    const std::uint32_t begin = moving_begin.load(std::memory_order_relaxed);
    if (found.faces_.size() < found.count_ + (list.end - begin))
        found.faces_.resize(2 * (found.count_ + (list.end - begin)));
    // Without branches on what an entry is like: it is as good as random.
    const Entry* entry = entries_.data() + begin;
    const Entry* const end = entries_.data() + list.end;
    std::uint32_t* next = found.faces_.data() + found.count_;
    std::uint32_t gone = 0, all_gone = 1;
    for (; entry != end && entry->most_minus_farthest <= query.most_minus_farthest; ++entry) {
        const std::uint32_t face = entry->face;
        const std::uint32_t pending = is_pending(face) ? 1 : 0;
        *next = face;
        next += static_cast<std::uint32_t>(query.holds(*entry)) & pending;
        all_gone &= ~pending;
        gone += all_gone;
    }
    found.count_ = static_cast<std::size_t>(next - found.faces_.data());
    if (gone != 0)
        moving_begin.store(begin + gone, std::memory_order_relaxed);
}

inline void PendingFaces::search(std::uint32_t face, Found& found)
{
    for (std::size_t chart = 0; chart < grids_.size(); ++chart) {
        const ImageBoxes::ImageBox& box = boxes_->box(face, static_cast<int>(chart));
        if (!box.present())
            continue;
        const Grid& grid = grids_[chart];
        const Sought by = grid.sought(box);
        const std::uint32_t left = grid.column(by.left), right = grid.column(by.right);
        const std::uint32_t low = grid.row(by.low), high = grid.row(by.high);
        for (std::uint32_t row = low; row <= high; ++row)
            for (std::uint32_t column = left; column <= right; ++column)
                look_through(lists_[grid.list(column, row)], grid.query(by, column, row), found);
        // As in the first square: there all count.
        look_through(lists_[grid.first_list], grid.query(by, left, low), found);
    }
}

} // namespace visorder::detail
