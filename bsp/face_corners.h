#pragma once

#include "scene/boundary.h"
#include "scene/face_overlap.h"
#include "scene/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace visorder {

/// The corners of the faces of a BSP tree, without repetitions, by numbers of their own. Immutable.
class FaceCorners {
public:
    using Corners = std::array<std::uint32_t, 4>;

    /// `has_area` tells the faces to take; the others have no corners.
    FaceCorners(const Mesh& mesh, std::span<const CellFace> faces, std::span<const std::uint8_t> has_area);

    /// Of a face, in order around it, the first three not on one line. The last of three stands twice.
    const Corners& of(std::uint32_t face) const { return corners_[face]; }
    static int count(const Corners& corners) { return corners[2] == corners[3] ? 3 : 4; }
    /// Bits of the corners of each of two faces that are also corners of the other.
    struct Common {
        unsigned of_first, of_second;
    };
    static Common common(const Corners& first, const Corners& second);

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
#else
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

} // namespace visorder
