#include "bsp/corner_heights.h"

#include "scene/adjacency.h"
#include "scene/face_planes.h"

#include <algorithm>
#include <oneapi/tbb/parallel_for.h>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace visorder::detail {

namespace {

// The filter of FaceSigns (unit_planes.cpp) is off by less than 2^-21 sum |e_i| + 2^-19 |w|; here the eye is a point of
// the scene, whose unit coordinates are within [-1, 1], and w = 1. Planes that are all zeros decide nothing.
constexpr float error_bound = 0x1p-18f;

} // namespace

CornerHeights::CornerHeights(const Scene& scene, std::span<const CellFace> faces, const FaceCorners& corners)
    : corners_(corners)
{
    records_.resize(faces.size());
    if (scene.is_surface() || corners.points().empty()) {
        std::fill(records_.begin(), records_.end(), Record{});
        return;
    }
    const FacePlanes& planes = scene.face_planes();
    const auto row = static_cast<std::size_t>(planes.row_length);
    oneapi::tbb::parallel_for(std::size_t{0}, faces.size(), [&](std::size_t i) {
        Record& record = records_[i];
        const FaceCorners::Corners& of_face = corners.of(static_cast<std::uint32_t>(i));
        for (std::size_t k = 0; k < of_face.size(); ++k) {
            const glm::dvec3 unit = planes.frame.unit(corners.points()[of_face[k]]);
            record.x[k] = static_cast<float>(unit.x);
            record.y[k] = static_cast<float>(unit.y);
            record.z[k] = static_cast<float>(unit.z);
            record.plane[k] = planes.plane[faces[i].cell * 4 * row + k * row + faces[i].face];
        }
    });
}

#if defined(__SSE2__)
CornerHeights::Sides CornerHeights::sides(const Record& plane, const Record& corners)
{
    const __m128 p = _mm_load_ps(plane.plane);
    const __m128 x = _mm_mul_ps(_mm_load_ps(corners.x), _mm_shuffle_ps(p, p, 0x00));
    const __m128 y = _mm_mul_ps(_mm_load_ps(corners.y), _mm_shuffle_ps(p, p, 0x55));
    const __m128 z = _mm_mul_ps(_mm_load_ps(corners.z), _mm_shuffle_ps(p, p, 0xaa));
    const __m128 height = _mm_add_ps(_mm_add_ps(_mm_add_ps(x, y), z), _mm_shuffle_ps(p, p, 0xff));
    return {static_cast<unsigned>(_mm_movemask_ps(_mm_cmpgt_ps(height, _mm_set1_ps(error_bound)))),
            static_cast<unsigned>(_mm_movemask_ps(_mm_cmplt_ps(height, _mm_set1_ps(-error_bound))))};
}
#else
CornerHeights::Sides CornerHeights::sides(const Record& plane, const Record& corners)
{
    Sides sides{0, 0};
    for (int k = 0; k < 4; ++k) {
        const float height = corners.x[k] * plane.plane[0] + corners.y[k] * plane.plane[1] +
                             corners.z[k] * plane.plane[2] + plane.plane[3];
        sides.outside |= static_cast<unsigned>(height > error_bound) << k;
        sides.inside |= static_cast<unsigned>(height < -error_bound) << k;
    }
    return sides;
}
#endif

bool CornerHeights::face_each_other(std::uint32_t f, std::uint32_t g) const
{
    const Sides at_f = sides(records_[f], records_[g]);
    const Sides at_g = sides(records_[g], records_[f]);
    const FaceCorners::Common common = FaceCorners::common(corners_.of(f), corners_.of(g));
    return (at_f.outside | common.of_second) == 15u && (at_g.outside | common.of_first) == 15u;
}

Sure CornerHeights::nearer(std::uint32_t f, std::uint32_t g) const
{
    const Sides at_f = sides(records_[f], records_[g]);
    const Sides at_g = sides(records_[g], records_[f]);
    const FaceCorners::Common common = FaceCorners::common(corners_.of(f), corners_.of(g));
    // Without branches: one answer is as likely as another.
    const bool g_known = (at_f.outside | at_f.inside | common.of_second) == 15u;
    const bool f_known = (at_g.outside | at_g.inside | common.of_first) == 15u;
    const unsigned no = static_cast<unsigned>(g_known & (at_f.outside == 0) & (at_f.inside != 0)) |
                        static_cast<unsigned>(f_known & (at_g.outside == 0) & (at_g.inside != 0));
    const unsigned yes = static_cast<unsigned>(g_known & (at_f.inside == 0) & (at_f.outside != 0)) |
                         static_cast<unsigned>(f_known & (at_g.inside == 0) & (at_g.outside != 0));
    return no != 0 ? Sure::no : yes != 0 ? Sure::yes : Sure::unknown;
}

} // namespace visorder::detail
