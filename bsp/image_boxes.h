#pragma once

#include "visorder/box.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <vector>

namespace visorder::detail {

/// When the walk of a BSP tree comes to a face first and last: numbers that grow along the walk.
struct Ranks {
    std::uint16_t first, last;
};

/// The boxes of faces in the charts of one eye, in single precision, and their ranks. Rounding keeps the order of
/// numbers, so boxes that meet in double precision meet here.
class ImageBoxes {
public:
    struct alignas(32) ImageBox {
        glm::vec2 min{std::numeric_limits<float>::infinity()};
        glm::vec2 max{-std::numeric_limits<float>::infinity()};
        float nearest = 0, farthest = 0;
        Ranks ranks{};

        bool present() const { return min.x <= max.x; }
        /// Whether, of what it knows, nothing shows that it covers no part of another face.
        bool may_cover(const ImageBox& other) const
        {
            // Without branches: one answer is as likely as another.
            const bool across =
                (min.x <= other.max.x) & (other.min.x <= max.x) & (min.y <= other.max.y) & (other.min.y <= max.y);
            return across & (nearest <= other.farthest) & (other.ranks.first <= ranks.last);
        }
    };

    /// Makes room for `faces` faces in `charts` charts, each to be set once in each chart.
    void reset(std::size_t faces, int charts);
    /// Any number of threads may set different faces.
    void set(std::size_t face, int chart, const Box& box, Ranks ranks);
    void set_absent(std::size_t face, int chart) { boxes_[place(face, chart)] = ImageBox{}; }

    std::size_t face_count() const { return faces_; }
    int chart_count() const { return charts_; }
    const ImageBox& box(std::size_t face, int chart) const { return boxes_[place(face, chart)]; }
    /// Whether a face may cover a part of another one, in some chart.
    bool may_cover(std::size_t face, std::size_t other) const
    {
        bool may = false;
        for (int chart = 0; chart < charts_; ++chart)
            may |= box(face, chart).may_cover(box(other, chart));
        return may;
    }
    void prefetch(std::size_t face) const { __builtin_prefetch(&box(face, 0)); }
    std::size_t bytes() const { return boxes_.capacity() * sizeof(ImageBox); }

private:
    std::size_t place(std::size_t face, int chart) const
    {
        return face * static_cast<std::size_t>(charts_) + static_cast<std::size_t>(chart);
    }

    std::size_t faces_ = 0;
    int charts_ = 0;
    std::vector<ImageBox> boxes_;
};

} // namespace visorder::detail
