#include "projection/screen.h"

#include "visorder/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace visorder::detail {

namespace {

void check(const View& view)
{
    validate(view);
    if (view.size.x < 1 || view.size.y < 1)
        throw InputError(fmt::format("view size {} x {}: must be at least 1 x 1", view.size.x, view.size.y));
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(view.world_to_clip[column][row]))
                throw InputError("the view's matrix has a number that is not finite");
}

glm::dvec3 row(const glm::dmat4& m, int r)
{
    return {m[0][r], m[1][r], m[2][r]};
}

glm::dmat3 inverse_of_rows(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
    const glm::dmat3 rows = glm::transpose(glm::dmat3(a, b, c));
    const glm::dmat3 inverse = glm::inverse(rows);
    for (int column = 0; column < 3; ++column)
        for (int r = 0; r < 3; ++r)
            if (!std::isfinite(inverse[column][r]))
                throw InputError("the view's matrix does not project onto an image");
    return inverse;
}

// The corner of a box that lies farthest along a direction.
glm::dvec3 farthest_corner(const Box& box, const glm::dvec3& along)
{
    return {along.x > 0 ? box.max.x : box.min.x, along.y > 0 ? box.max.y : box.min.y,
            along.z > 0 ? box.max.z : box.min.z};
}

} // namespace

Screen::Screen(const View& view, const Box& bounds) : perspective_(view.eye.w != 0), size_(view.size)
{
    check(view);
    centre_ = size_ / 2;
    // Pixels from the centre are half * normalised device coordinates + shift.
    const glm::dvec2 half = glm::dvec2(size_) * 0.5;
    const glm::dvec2 shift = half - glm::dvec2(centre_);
    const glm::dmat4& m = view.world_to_clip;
    const glm::dvec3 w = row(m, 3);
    if (perspective_) {
        reference_ = glm::dvec3(view.eye) / view.eye.w;
        x_ = half.x * row(m, 0) + shift.x * w;
        y_ = half.y * row(m, 1) + shift.y * w;
        depth_ = w;
        depth_reference_ = farthest_corner(bounds, depth_);
        distance_ = glm::dot(depth_, depth_reference_ - reference_);
        // With the whole scene behind the eye nothing is drawn, and any distance will do.
        if (distance_ <= 0)
            distance_ = 1;
        inverse_distance_ = 1 / distance_;
        rays_ = inverse_of_rows(x_, y_, depth_);
    } else {
        reference_ = bounds.middle();
        const glm::dvec4 middle = m * glm::dvec4(reference_, 1);
        if (w != glm::dvec3(0) || middle.w == 0)
            throw InputError("the view's eye is infinitely far, but its matrix is that of a perspective view");
        x_ = half.x * row(m, 0) / middle.w;
        y_ = half.y * row(m, 1) / middle.w;
        constant_ = {half.x * middle.x / middle.w + shift.x, half.y * middle.y / middle.w + shift.y};
        const glm::dvec3 towards_viewer(view.eye);
        const glm::dvec3 scaled =
            towards_viewer / std::max({std::abs(view.eye.x), std::abs(view.eye.y), std::abs(view.eye.z)});
        depth_ = -glm::normalize(scaled);
        depth_reference_ = reference_;
        const glm::dmat3 inverse = inverse_of_rows(x_, y_, depth_);
        rays_ = glm::dmat3(glm::dvec3(0), glm::dvec3(0), inverse[2]);
    }
    // A view that is no mirror has x to the right, y up and z towards the viewer.
    mirrors_ = glm::dot(glm::cross(x_, y_), depth_) > 0;
}

ScreenPoint Screen::seen(const glm::dvec3& point) const
{
    const glm::dvec3 from = point - reference_;
    const double z = glm::dot(depth_, point - depth_reference_);
    if (!perspective_)
        return {glm::dot(x_, from) + constant_.x, glm::dot(y_, from) + constant_.y, z, 1};
    const double d = glm::dot(depth_, from);
    return {glm::dot(x_, from) / d, glm::dot(y_, from) / d, distance_ * z / d, d * inverse_distance_};
}

double Screen::longest_ray() const
{
    const glm::dvec2 low = -glm::dvec2(centre_);
    const glm::dvec2 high = low + glm::dvec2(size_);
    double longest = 0;
    for (const glm::dvec2 corner : {low, high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)})
        longest = std::max(longest, glm::length(rays_ * glm::dvec3(corner, 1)));
    return longest;
}

Screen::Anywhere Screen::anywhere(const glm::dvec3& point) const
{
    const glm::dvec3 from = point - reference_;
    const double depth = glm::dot(depth_, from);
    return {{glm::dot(x_, from) + constant_.x, glm::dot(y_, from) + constant_.y, perspective_ ? depth : 1}, depth};
}

} // namespace visorder::detail
