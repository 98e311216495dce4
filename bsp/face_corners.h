#pragma once

#include "geometry/face_overlap.h"
#include "scene/adjacency.h"
#include "scene/boundary.h"
#include "visorder/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace visorder::detail {

/// The corners of the faces of a BSP tree, without repetitions, by numbers of their own. Immutable.
class FaceCorners {
public:
    using Corners = std::array<std::uint32_t, 4>;

    /// `has_area` tells the faces to take; the others have no corners.
    FaceCorners(const Mesh& mesh, std::span<const CellFace> faces, std::span<const std::uint8_t> has_area);

    /// Of a face, in order around it, the first three not on one line. The last of three stands twice.
    const Corners& of(std::uint32_t face) const { return corners_[face]; }
    /// Has fetched what `of` reads.
    void prefetch(std::uint32_t face) const { __builtin_prefetch(&corners_[face]); }
    /// Whether a face was taken.
    bool has(std::uint32_t face) const { return corners_[face][0] != corners_[face][1]; }
    static int count(const Corners& corners) { return corners[2] == corners[3] ? 3 : 4; }
    /// Bits of the corners of each of two faces that are also corners of the other.
    struct Common {
        unsigned of_first, of_second;
    };
    static Common common(const Corners& first, const Corners& second);
    /// Of each edge of the first face, from corner i to the next in four bits from 4 i on, those corners of the second
    /// that are its ends.
    static unsigned ends_in(const Corners& first, const Corners& second);

    /// Where the corners are.
    std::span<const glm::dvec3> points() const { return points_; }
    /// A face as an eye sees it.
    SeenFace seen(std::uint32_t face, const glm::dvec4& eye) const;

    std::size_t face_count() const { return corners_.size(); }
    std::size_t bytes() const
    {
        return corners_.capacity() * sizeof(Corners) + points_.capacity() * sizeof(glm::dvec3);
    }

private:
    std::vector<Corners> corners_;
    std::vector<glm::dvec3> points_; // in the order of the scene's
};

#if defined(__SSE2__)
inline FaceCorners::Common FaceCorners::common(const Corners& first, const Corners& second)
{
    const auto load = [](const Corners& corners) {
        return _mm_loadu_si128(reinterpret_cast<const __m128i*>(corners.data()));
    };
    const __m128i a = load(first), b = load(second);
    const auto in = [](__m128i of, __m128i all) {
        const __m128i two = _mm_or_si128(_mm_cmpeq_epi32(of, _mm_shuffle_epi32(all, 0x00)),
                                         _mm_cmpeq_epi32(of, _mm_shuffle_epi32(all, 0x55)));
        const __m128i others = _mm_or_si128(_mm_cmpeq_epi32(of, _mm_shuffle_epi32(all, 0xaa)),
                                            _mm_cmpeq_epi32(of, _mm_shuffle_epi32(all, 0xff)));
        return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(_mm_or_si128(two, others))));
    };
    return {in(a, b), in(b, a)};
}

inline unsigned FaceCorners::ends_in(const Corners& first, const Corners& second)
{
    const __m128i all = _mm_loadu_si128(reinterpret_cast<const __m128i*>(second.data()));
    unsigned same = 0; // four bits for each of the first's corners
    for (unsigned i = 0; i < 4; ++i) {
        const __m128i equal = _mm_cmpeq_epi32(all, _mm_set1_epi32(static_cast<int>(first[i])));
        same |= static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(equal))) << 4 * i;
    }
    // The last of three corners stands twice, so the first is next to the fourth as well as to the third.
    const unsigned next = same >> 4 | (same & 15u) << 12;
    return first[2] == first[3] ? same | (next & 0xffu) | (same & 15u) << 8 : same | next;
}
#else
inline unsigned FaceCorners::ends_in(const Corners& first, const Corners& second)
{
    const auto corners = static_cast<unsigned>(count(first));
    unsigned ends = 0;
    for (unsigned i = 0; i < corners; ++i)
        for (unsigned k = 0; k < 4; ++k)
            ends |= static_cast<unsigned>(second[k] == first[i] || second[k] == first[(i + 1) % corners])
                    << (4 * i + k);
    return ends;
}

inline FaceCorners::Common FaceCorners::common(const Corners& first, const Corners& second)
{
    Common common{0, 0};
    for (unsigned i = 0; i < 4; ++i)
        for (unsigned k = 0; k < 4; ++k) {
            const auto same = static_cast<unsigned>(first[i] == second[k]);
            common.of_first |= same << i;
            common.of_second |= same << k;
        }
    return common;
}
#endif

} // namespace visorder::detail
