#include "geometry/projection_charts.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace visorder::detail {

namespace {

constexpr double u = std::numeric_limits<double>::epsilon() / 2;
// Beyond this, sums and products of a few coordinates might overflow.
constexpr double huge = 1e300;
// Below this, roundings of products might be above u times them.
constexpr double tiny = 1e-280;

// More than the roundings of some products that underflow add up to.
constexpr double underflow = 0x1p-1068;

constexpr double whole_range = std::numeric_limits<double>::max();

struct Polygon {
    std::array<glm::dvec3, 8> points; // four corners, and one more for each of four cuts
    int count = 0;
};

// What remains where `height`, an affine function, is not negative.
template <class Height>
Polygon cut(const Polygon& polygon, const Height& height)
{
    Polygon rest;
    const auto push = [&](const glm::dvec3& x) { rest.points[static_cast<std::size_t>(rest.count++)] = x; };
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec3& a = polygon.points[static_cast<std::size_t>(i)];
        const glm::dvec3& b = polygon.points[static_cast<std::size_t>(i + 1 == polygon.count ? 0 : i + 1)];
        const double at_a = height(a), at_b = height(b);
        if (at_a >= 0)
            push(a);
        if ((at_a >= 0) != (at_b >= 0))
            push(a + (b - a) * (at_a / (at_a - at_b)));
    }
    return rest;
}

} // namespace

ProjectionCharts::ProjectionCharts(const Box& bounds, const glm::dvec4& eye) : parallel_(eye.w == 0)
{
    if (parallel_)
        set_direction(glm::dvec3(eye), bounds);
    else
        set_position(eye, bounds);
}

std::optional<Box> ProjectionCharts::box(std::span<const glm::dvec3> face, int chart) const
{
    if (in_one_plane_) {
        Box box;
        for (const glm::dvec3& p : face)
            box.add(image(p));
        return Box{box.min - image_error_, box.max + image_error_};
    }
    if (parallel_)
        return Box{glm::dvec3(-whole_range), glm::dvec3(whole_range)};
    return box_in_side(face, sides_[static_cast<std::size_t>(chart)]);
}

// `away` against `towards`, and two more, each of unit length and at right angles but for roundings.
void ProjectionCharts::set_axes(const glm::dvec3& towards)
{
    const glm::dvec3 size = glm::abs(towards);
    const glm::dvec3 back = glm::normalize(towards / std::max({size.x, size.y, size.z}));
    const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    right_ = glm::normalize(glm::cross(least, back));
    up_ = glm::cross(back, right_);
    away_ = -back;
}

void ProjectionCharts::set_direction(const glm::dvec3& towards, const Box& bounds)
{
    set_axes(towards);
    origin_ = bounds.middle();
    const glm::dvec3 half = bounds.max * 0.5 - bounds.min * 0.5;
    const double radius = half.x + half.y + half.z;
    in_one_plane_ = radius < huge;
    // Let two points of the scene lie on one ray, up to 2 radius apart. With axes off the true direction by at most
    // 12 u, the points' images are at most 24 u radius apart; each is computed to within 6 u radius (a rounded
    // difference and a sum of three products). 1e-14 is 90 u.
    image_error_ = glm::dvec3(1e-14 * radius + underflow);
}

void ProjectionCharts::set_position(const glm::dvec4& eye, const Box& bounds)
{
    origin_ = glm::dvec3(eye) / eye.w;
    const glm::dvec3 size = glm::abs(origin_);
    // Division by 1 or -1 does not round.
    const bool exact = std::abs(eye.w) == 1;
    margin_ = exact ? 0.0 : u * std::max({size.x, size.y, size.z}) + std::numeric_limits<double>::min();
    in_one_plane_ = set_plane(bounds);
    if (!in_one_plane_)
        set_sides(bounds);
}

// The image of x, which lies d off the position, is (right . d, up . d) / (away . d). The rounded axes are as good as
// true ones: whatever they are, this is the same for all points on one ray.
bool ProjectionCharts::set_plane(const Box& bounds)
{
    const glm::dvec3 low = bounds.min - origin_, high = bounds.max - origin_;
    const glm::dvec3 most = glm::max(glm::abs(low), glm::abs(high));
    const double reach = std::max({most.x, most.y, most.z});
    const glm::dvec3 towards = low * -0.5 + high * -0.5;
    if (!(reach > tiny && reach < huge && (towards.x != 0 || towards.y != 0 || towards.z != 0)))
        return false;
    set_axes(towards);
    // Of a product of d with an axis: its components are off by u reach and the position's margin, of which the axis
    // takes sqrt(3) times as much, and the sum of the products by 3 u sqrt(3) reach.
    const double error = 16 * u * reach + 4 * margin_;
    // The least that any away . d is, true or rounded: least at a corner.
    double nearest = reach;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 d((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                           (corner & 4) != 0 ? high.z : low.z);
        nearest = std::min(nearest, glm::dot(away_, d));
    }
    nearest -= 4 * error;
    if (!(nearest > reach / 16))
        return false;
    // No image coordinate is above 2 reach / nearest. A quotient is off by (1 + its size) error / nearest, and by its
    // rounding.
    const double along = 2 * (1 + 2 * reach / nearest) * (error / nearest + u);
    image_error_ = {along, along, error};
    return true;
}

void ProjectionCharts::set_sides(const Box& bounds)
{
    // A side shows nothing of the scene if it shows nothing of a box that holds it: if all corners are beyond one of
    // the planes that bound it. Widened as in box_in_side.
    const glm::dvec3 least = bounds.min - origin_, most = bounds.max - origin_;
    const glm::dvec3 reach = glm::max(glm::abs(least), glm::abs(most));
    const double wider = 0x1p-20 * std::max({reach.x, reach.y, reach.z}) + 8 * margin_;
    const double farthest = std::max({reach.x, reach.y, reach.z});
    const bool measurable = reach.x < huge && reach.y < huge && reach.z < huge && farthest > tiny;
    count_ = 0;
    for (int side = 0; side < 6; ++side) {
        const glm::length_t axis = side / 2;
        const double z = side % 2 == 0 ? most[axis] : -least[axis];
        bool beyond = false;
        for (const glm::length_t cross : {(axis + 1) % 3, (axis + 2) % 3})
            beyond = beyond || z + wider - least[cross] < 0 || z + wider + most[cross] < 0;
        if (!measurable || !beyond)
            sides_[static_cast<std::size_t>(count_++)] = side;
    }
}

// Side `side` of the cube shows the rays with |a| <= z and |b| <= z, where z is along one of the axes or against
// it and a and b are along the other two; their image is (a / z, b / z).
std::optional<Box> ProjectionCharts::box_in_side(std::span<const glm::dvec3> face, int side) const
{
    const glm::length_t axis = side / 2;
    const double towards = side % 2 == 0 ? 1 : -1;
    Polygon polygon;
    double size = 0;
    for (const glm::dvec3& p : face) {
        const glm::dvec3 d = p - origin_;
        polygon.points[static_cast<std::size_t>(polygon.count++)] = {d[(axis + 1) % 3], d[(axis + 2) % 3],
                                                                     towards * d[axis]};
        size = std::max({size, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    }
    // Written so that what is not a number is everywhere.
    if (!(size > tiny && size < huge && std::isfinite(origin_.x + origin_.y + origin_.z)))
        return Box{{-1, -1, 0}, {1, 1, whole_range}};

    // The side is taken a little wider than it is, by far more than the roundings of the corners (u size, and that
    // of the position) and of the cuts (some 16 u size more), so that no part of the face within it is cut off.
    const double wider = 0x1p-30 * size + 4 * margin_;
    for (glm::length_t cross = 0; cross < 2; ++cross)
        for (const double sign : {1.0, -1.0}) {
            const auto height = [&](const glm::dvec3& x) { return x.z + wider - sign * x[cross]; };
            const auto* begin = polygon.points.data();
            const auto* end = begin + polygon.count;
            if (std::any_of(begin, end, [&](const glm::dvec3& x) { return height(x) < 0; }))
                polygon = cut(polygon, height);
        }
    if (polygon.count == 0)
        return std::nullopt;

    const double error = 32 * u * size + 4 * margin_;
    Box box;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec3& x = polygon.points[static_cast<std::size_t>(i)];
        box.add(glm::dvec3(x.x / x.z, x.y / x.z, x.z));
    }
    const double nearest = box.min.z - error, farthest = box.max.z + error;
    // Too near to the eye for its size: doubles do not say where it is in the image.
    if (!(nearest > 0x1p-20 * size))
        return Box{{-1, -1, 0}, {1, 1, farthest}};
    // With |a| <= (1 + 2^-10) z, errors of both move the quotient by at most 2.001 error / z, and by its rounding.
    const double margin = 4 * error / nearest + 4 * u;
    return Box{{std::max(box.min.x - margin, -1.0), std::max(box.min.y - margin, -1.0), nearest},
               {std::min(box.max.x + margin, 1.0), std::min(box.max.y + margin, 1.0), farthest}};
}

} // namespace visorder::detail
