#pragma once

#include "scene/box.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <vector>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

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

/// When the walk of a BSP tree comes to a face first and last: `Ranks::first` and `last` of each face, which grow along
/// the walk.
struct Ranks {
    std::vector<std::uint16_t> first, last;
};

/// Entry faces by where they are in the image and in the walk of a BSP tree, to find those that an exit face may cover:
/// a grid over each chart, whose squares list their faces in the order of the walk. A face is pending until its cell is
/// listed.
///
/// Boxes are kept in 16-bit numbers, to which single precision is mapped without changing its order: what meets there
/// meets here.
class PendingFaces {
public:
    /// Takes the faces with is_entry(face), all of them pending, and makes ready to search by any other.
    template <class IsEntry>
    void reset(const ImageBoxes& boxes, const Ranks& ranks, IsEntry&& is_entry);

    /// The face's cell has been listed.
    void remove(std::uint32_t face) { is_gone_[face] = 1; }

    /// Calls visit(face) for each pending one that face `face` may cover, once a chart at most, until it returns false:
    /// their boxes meet, not all of the entry face is nearer, and the walk came to it before it left `face`. In each
    /// square those that the walk came to last come first, if there are few. Some time before, it calls prepare(face).
    /// Any number of threads may search side by side.
    template <class Prepare, class Visit>
    void search(std::uint32_t face, Prepare&& prepare, Visit&& visit);

    std::size_t bytes() const;

private:
    // A face over more squares of the grid than this is kept apart, in a list that all searches go through.
    static constexpr std::size_t most_squares = 64;

    using Number = std::uint16_t;
    static constexpr Number most = 0xffff;
    // Lists are in the order of ranks, to 12 bits.
    static constexpr int rank_shift = 4;
    static constexpr std::size_t rank_count = 0x10000 >> rank_shift;
    static constexpr std::size_t visits_at_once = 16;

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
        unsigned last_rank; // as lists are ordered

        bool holds(const Entry& entry) const;
    };
    // A face that may cover others.
    struct Sought {
        Number left, low, right, high;
        Number nearest;
        Number last_rank;
        bool present = false;
    };
    struct Grid {
        std::uint32_t columns = 1, rows = 1;
        int column_shift = 0, row_shift = 0; // from numbers to squares
        Scale x, y, depth;
        std::size_t first_list = 0; // of the faces too large for the grid; those of its squares follow

        Entry entry(const ImageBoxes::ImageBox& box, Number first_rank, std::uint32_t face) const
        {
            const auto from_most = [](Number number) { return static_cast<Number>(most - number); };
            return {x.number(box.min.x),
                    y.number(box.min.y),
                    from_most(x.number(box.max.x)),
                    from_most(y.number(box.max.y)),
                    from_most(depth.number(box.max.z)),
                    first_rank,
                    face};
        }
        Sought sought(const ImageBoxes::ImageBox& box, Number last_rank) const
        {
            return {x.number(box.min.x),
                    y.number(box.min.y),
                    x.number(box.max.x),
                    y.number(box.max.y),
                    depth.number(box.min.z),
                    last_rank,
                    true};
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
                    unsigned{by.last_rank} >> rank_shift};
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

    template <class Prepare, class Visit>
    bool look_through(List& list, const Query& query, Prepare&& prepare, Visit&& visit);

    std::size_t charts() const { return grids_.size(); }

    std::vector<Grid> grids_; // a chart
    std::vector<List> lists_;
    std::vector<Entry> entries_;
    std::vector<std::uint8_t> is_gone_; // a face
    std::vector<Sought> sought_;        // a face in each chart

    // Of one chart, while it is filled.
    std::vector<Entry> faces_;
    std::vector<std::uint32_t> by_rank_; // in faces_
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
void PendingFaces::reset(const ImageBoxes& boxes, const Ranks& ranks, IsEntry&& is_entry)
{
    grids_.clear();
    lists_.clear();
    entries_.clear();
    const auto count = static_cast<std::uint32_t>(boxes.face_count());
    const auto all_charts = static_cast<std::size_t>(boxes.chart_count());
    sought_.resize(count * all_charts);
    for (std::size_t chart = 0; chart < all_charts; ++chart) {
        const auto box = [&](std::uint32_t face) { return boxes.box(face, static_cast<int>(chart)); };
        const auto present = [&](std::uint32_t face) { return boxes.present(face, static_cast<int>(chart)); };
        Extent extent;
        for (std::uint32_t face = 0; face < count; ++face)
            if (is_entry(face) && present(face))
                extent.add(box(face));
        const Grid& of_chart = grids_.emplace_back(grid(extent, lists_.size()));
        faces_.clear();
        for (std::uint32_t face = 0; face < count; ++face)
            if (is_entry(face) && present(face))
                faces_.push_back(of_chart.entry(box(face), ranks.first[face], face));
        oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, count, 8192), [&](const auto& range) {
            for (std::uint32_t face = range.begin(); face < range.end(); ++face)
                sought_[face * all_charts + chart] =
                    present(face) ? of_chart.sought(box(face), ranks.last[face]) : Sought{};
        });
        fill(of_chart);
    }
    is_gone_.assign(count, 0);
}

template <class Prepare, class Visit>
bool PendingFaces::look_through(List& list, const Query& query, Prepare&& prepare, Visit&& visit)
{
    const Entry* const entries = entries_.data();
    const std::uint8_t* const is_gone = is_gone_.data();
    // A hint that threads need not agree on.
    const std::atomic_ref<std::uint32_t> moving_begin(list.begin);
    const std::uint32_t begin = moving_begin.load(std::memory_order_relaxed);
    std::uint32_t at = begin;
    // Without branches on what an entry is like: it is as good as random.
    std::array<std::uint32_t, visits_at_once> found;
    std::size_t count = 0;
    bool go_on = true;
    const auto visit_found = [&] {
        std::for_each_n(found.begin(), count, prepare);
        while (go_on && count > 0)
            go_on = visit(found[--count]);
        count = 0;
    };
    for (; at < list.end && (entries[at].first_rank >> rank_shift) <= query.last_rank; ++at) {
        if (count == visits_at_once) [[unlikely]] {
            visit_found();
            if (!go_on)
                return false;
        }
        found[count] = entries[at].face;
        count += static_cast<std::size_t>(query.holds(entries[at]) & (is_gone[entries[at].face] == 0));
    }
    visit_found();
    std::uint32_t gone = begin;
    while (gone < at && is_gone[entries[gone].face] != 0)
        ++gone;
    if (gone != begin)
        moving_begin.store(gone, std::memory_order_relaxed);
    return go_on;
}

template <class Prepare, class Visit>
void PendingFaces::search(std::uint32_t face, Prepare&& prepare, Visit&& visit)
{
    for (std::size_t chart = 0; chart < charts(); ++chart) {
        const Sought by = sought_[face * charts() + chart];
        if (!by.present)
            continue;
        const Grid& grid = grids_[chart];
        const std::uint32_t left = grid.column(by.left), right = grid.column(by.right);
        const std::uint32_t low = grid.row(by.low), high = grid.row(by.high);
        for (std::uint32_t row = low; row <= high; ++row)
            for (std::uint32_t column = left; column <= right; ++column)
                if (!look_through(lists_[grid.list(column, row)], grid.query(by, column, row), prepare, visit))
                    return;
        // As in the first square: there all count.
        if (!look_through(lists_[grid.first_list], grid.query(by, left, low), prepare, visit))
            return;
    }
}

} // namespace visorder
