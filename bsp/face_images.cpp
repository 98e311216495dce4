#include "bsp/face_images.h"

#include <array>
#include <cmath>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace visorder {

struct FaceImages::Polygon {
    const FaceCorners::Corners& corners;
    int count;
    std::array<glm::dvec2, 4> images;

    std::size_t next(std::size_t i) const { return static_cast<int>(i) + 1 == count ? 0 : i + 1; }
};

void FaceImages::project(const ProjectionCharts& charts)
{
    const std::span<const glm::dvec3> points = corners_.points();
    images_.resize(points.size());
    depths_.resize(points.size());
    error_ = charts.image_error();
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, points.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const glm::dvec3 image = charts.image(points[i]);
            images_[i] = glm::dvec2(image);
            depths_[i] = image.z;
        }
    });
}

Box FaceImages::box(std::uint32_t face) const
{
    Box box;
    for (std::uint32_t corner : corners_.of(face))
        box.add(glm::dvec3(images_[corner], depths_[corner]));
    return {box.min - error_, box.max + error_};
}

FaceImages::Polygon FaceImages::polygon(std::uint32_t face) const
{
    const FaceCorners::Corners& corners = corners_.of(face);
    Polygon polygon{corners, FaceCorners::count(corners), {}};
    for (std::size_t i = 0; i < 4; ++i)
        polygon.images[i] = images_[corners[i]];
    return polygon;
}

// Positive or negative where a, b, c stand for sure counterclockwise or clockwise, else zero. With e the error of a
// coordinate, which is at least the rounding of a difference of two (image_error is more than 4 u times any image), the
// differences are off by at most 3 e. So the determinant of p = b - a and q = c - a is off by at most 3 e (|p| + |q|) +
// 18 e^2 and its roundings, 3 u |px qy| + 3 u |py qx|, which are less than e (|p| + |q|), sizes being sums of both
// components.
double FaceImages::turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) const
{
    const glm::dvec2 p = b - a, q = c - a;
    const double value = p.x * q.y - p.y * q.x;
    const double size = std::abs(p.x) + std::abs(p.y) + std::abs(q.x) + std::abs(q.y);
    const double bound = 8 * error_.x * (size + 4 * error_.x) + 1e-300; // more than what underflows
    return std::abs(value) > bound && std::abs(value) <= std::numeric_limits<double>::max() ? value : 0.0;
}

FaceImages::Separation FaceImages::separate(const Polygon& polygon, const Polygon& other) const
{
    const double inside = turn(polygon.images[0], polygon.images[1], polygon.images[2]);
    if (inside == 0)
        return {false, true};
    bool all_have_inside = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        const std::size_t next = polygon.next(i);
        const glm::dvec2 &a = polygon.images[i], &b = polygon.images[next];
        bool some_inside = false, all_outside = true;
        for (std::size_t k = 0; k < static_cast<std::size_t>(other.count) && !some_inside; ++k) {
            const double side = turn(a, b, other.images[k]) * inside;
            some_inside = side > 0;
            all_outside = all_outside && (side < 0 || other.corners[k] == polygon.corners[i] ||
                                          other.corners[k] == polygon.corners[next]);
        }
        if (all_outside && !some_inside)
            return {true, false};
        all_have_inside = all_have_inside && some_inside;
    }
    return {false, !all_have_inside};
}

// Convex polygons share no area exactly if the line of some edge of one has all of the other weakly outside.
Shared FaceImages::shared(std::uint32_t f, std::uint32_t g) const
{
    const Polygon of_f = polygon(f), of_g = polygon(g);
    const Separation by_g = separate(of_g, of_f);
    if (by_g.separated)
        return Shared::nothing;
    const Separation by_f = separate(of_f, of_g);
    if (by_f.separated)
        return Shared::nothing;
    return by_f.unknown || by_g.unknown ? Shared::unknown : Shared::area;
}

} // namespace visorder
