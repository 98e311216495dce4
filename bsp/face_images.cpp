#include "bsp/face_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace visorder::detail {

namespace {

constexpr double most_size = 1e150; // of larger ones, products would overflow

} // namespace

struct FaceImages::Polygon {
    int count;
    alignas(16) std::array<double, 4> x, y; // the last of three stands twice
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

// What a turn, the determinant of p = b - a and q = c - a, may be off by where neither is larger than `size`, in the
// sum of both components. With e the error of a coordinate, which is at least the rounding of a difference of two
// (image_error is more than 4 u times any image), the differences are off by at most 3 e. So the determinant is off by
// at most 3 e (|p| + |q|) + 18 e^2 and its roundings, 3 u |px qy| + 3 u |py qx|, which are less than e (|p| + |q|).
double FaceImages::turn_bound(double size) const
{
    return 8 * error_.x * (2 * size + 4 * error_.x) + 1e-300; // more than what underflows
}

FaceImages::Polygon FaceImages::polygon(std::uint32_t face) const
{
    const FaceCorners::Corners& corners = corners_.of(face);
    Polygon polygon{FaceCorners::count(corners), {}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
        polygon.x[i] = images_[corners[i]].x;
        polygon.y[i] = images_[corners[i]].y;
    }
    return polygon;
}

// Whether some edge of a polygon has all of the other weakly outside, for sure: `nothing`. Else `area`, if each for
// sure has a corner of it strictly inside. `ends`: see FaceCorners::ends_in.
//
// A corner is inside or outside for sure if the edge, to it, turns by more than the bound.
Shared FaceImages::outside(const Polygon& polygon, const Polygon& other, unsigned ends, double bound)
{
    const auto turn = [&](std::size_t a, std::size_t b, double x, double y) {
        return (polygon.x[b] - polygon.x[a]) * (y - polygon.y[a]) - (polygon.y[b] - polygon.y[a]) * (x - polygon.x[a]);
    };
    const double inside = turn(0, 1, polygon.x[2], polygon.y[2]);
    if (!(std::abs(inside) > bound && std::abs(inside) <= std::numeric_limits<double>::max()))
        return Shared::unknown;
    const double least_inside = inside > 0 ? bound : -bound;
    bool all_have_inside = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        const std::size_t next = static_cast<int>(i) + 1 == polygon.count ? 0 : i + 1;
        unsigned above = 0, below = 0;
        for (unsigned k = 0; k < 4; ++k) {
            const double value = turn(i, next, other.x[k], other.y[k]);
            above |= static_cast<unsigned>(value > bound) << k;
            below |= static_cast<unsigned>(value < -bound) << k;
        }
        if (least_inside < 0)
            std::swap(above, below);
        if (((below | ends >> 4 * i) & 15u) == 15u)
            return Shared::nothing;
        all_have_inside = all_have_inside && above != 0;
    }
    return all_have_inside ? Shared::area : Shared::unknown;
}

// Convex polygons share no area exactly if the line of some edge of one has all of the other weakly outside.
Shared FaceImages::shared(std::uint32_t f, std::uint32_t g) const
{
    const Polygon of_f = polygon(f), of_g = polygon(g);
    const auto extent = [](const std::array<double, 4>& a, const std::array<double, 4>& b) {
        double least = a[0], most = a[0];
        for (std::size_t i = 0; i < 4; ++i) {
            least = std::min({least, a[i], b[i]});
            most = std::max({most, a[i], b[i]});
        }
        return most - least;
    };
    const double size = extent(of_f.x, of_g.x) + extent(of_f.y, of_g.y);
    if (!(size < most_size))
        return Shared::unknown;
    const double bound = turn_bound(size);
    const FaceCorners::Corners &at_f = corners_.of(f), &at_g = corners_.of(g);
    const Shared by_g = outside(of_g, of_f, FaceCorners::ends_in(at_g, at_f), bound);
    if (by_g == Shared::nothing)
        return by_g;
    const Shared by_f = outside(of_f, of_g, FaceCorners::ends_in(at_f, at_g), bound);
    return by_f == Shared::area && by_g == Shared::unknown ? by_g : by_f;
}

// Both are in the angles between their sides at the corner, and share an area exactly if these do: if the line of none
// of the four sides has the angles, weakly, on either side of it.
FaceImages::SharedAngle FaceImages::shared_at(std::uint32_t f, std::size_t i, std::uint32_t g, std::size_t k) const
{
    struct Angle {
        glm::dvec2 from, to;
        unsigned from_bit, to_bit; // of `sides`
    };
    double size = 0;
    const auto angle = [&](const FaceCorners::Corners& corners, std::size_t at, unsigned shift) {
        const auto count = static_cast<std::size_t>(FaceCorners::count(corners));
        const glm::dvec2& corner = images_[corners[at]];
        const Angle at_corner{images_[corners[at + 1 == count ? 0 : at + 1]] - corner,
                              images_[corners[at == 0 ? count - 1 : at - 1]] - corner, 1u << shift, 2u << shift};
        size = std::max({size, std::abs(at_corner.from.x) + std::abs(at_corner.from.y),
                         std::abs(at_corner.to.x) + std::abs(at_corner.to.y)});
        return at_corner;
    };
    const auto turn = [](const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; };
    Angle of_f = angle(corners_.of(f), i, 0), of_g = angle(corners_.of(g), k, 2);
    const double bound = turn_bound(size);
    const auto order = [&](Angle& angle_at) {
        const double turned = turn(angle_at.from, angle_at.to);
        if (turned < 0) {
            std::swap(angle_at.from, angle_at.to);
            std::swap(angle_at.from_bit, angle_at.to_bit);
        }
        return std::abs(turned) > bound;
    };
    // Written so that nothing is known of what is not a number.
    if (!(size < most_size && order(of_f) && order(of_g)))
        return {Shared::unknown, 0};
    const double from_from = turn(of_f.from, of_g.from), from_to = turn(of_f.from, of_g.to);
    const double to_from = turn(of_f.to, of_g.from), to_to = turn(of_f.to, of_g.to);
    const auto left = [&](double turned) { return turned > bound; };
    const auto right = [&](double turned) { return turned < -bound; };
    if ((right(from_from) & right(from_to)) | (left(to_from) & left(to_to)) | (left(from_from) & left(to_from)) |
        (right(from_to) & right(to_to)))
        return {Shared::nothing, 0};
    const bool area = (left(from_from) | left(from_to)) & (right(to_from) | right(to_to)) &
                      (right(from_from) | right(to_from)) & (left(from_to) | left(to_to));
    if (!area)
        return {Shared::unknown, 0};
    // Both angles are less than half a turn: what is shared begins where the later one does and ends with the earlier.
    const unsigned begin = left(from_from) ? of_g.from_bit : right(from_from) ? of_f.from_bit : 0;
    const unsigned end = right(to_to) ? of_g.to_bit : left(to_to) ? of_f.to_bit : 0;
    return {Shared::area, begin != 0 && end != 0 ? begin | end : 0};
}

} // namespace visorder::detail
