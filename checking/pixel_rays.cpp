#include "checking/pixel_rays.h"

#include "visorder/error.h"

#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace visorder::detail {

namespace {

glm::dvec4 row(const glm::dmat4& matrix, int i)
{
    return {matrix[0][i], matrix[1][i], matrix[2][i], matrix[3][i]};
}

bool is_finite(const glm::dmat4& matrix)
{
    for (int column = 0; column < 4; ++column)
        for (int i = 0; i < 4; ++i)
            if (!std::isfinite(matrix[column][i]))
                return false;
    return true;
}

} // namespace

PixelRays::PixelRays(const View& view, const glm::dvec3& reference) : size_(view.size), reference_(reference)
{
    validate(view);
    if (size_.x < 1 || size_.y < 1)
        throw InputError(fmt::format("view size {} x {}: must be at least 1 x 1", size_.x, size_.y));
    if (!is_finite(view.world_to_clip))
        throw InputError("the view's matrix is not finite");
    const glm::dvec4 w = row(view.world_to_clip, 3);
    const glm::dvec4 x = (row(view.world_to_clip, 0) + w) * (size_.x / 2.0);
    const glm::dvec4 y = (row(view.world_to_clip, 1) + w) * (size_.y / 2.0);
    x_ = glm::dvec3(x);
    y_ = glm::dvec3(y);
    w_ = glm::dvec3(w);
    clip_to_world_ = glm::inverse(view.world_to_clip);

    const bool parallel = view.eye.w == 0;
    if (parallel != (w_ == glm::dvec3(0)))
        throw InputError(parallel ? "the eye is at infinity, but the view's matrix is not of a parallel projection"
                                  : "the eye is a position, but the view's matrix is of a parallel projection");
    glm::dvec3 from_eye; // of the reference point
    if (parallel) {
        x_ /= w.w;
        y_ /= w.w;
        constant_ = {(glm::dot(glm::dvec3(x), reference) + x.w) / w.w,
                     (glm::dot(glm::dvec3(y), reference) + y.w) / w.w};
        w_constant_ = 1;
        forward_ = glm::normalize(glm::cross(glm::normalize(x_), glm::normalize(y_)));
        if (glm::dot(forward_, glm::dvec3(view.eye)) > 0)
            forward_ = -forward_;
        first_depth_ = -std::numeric_limits<double>::infinity();
    } else {
        from_eye = reference - glm::dvec3(view.eye) / view.eye.w;
        constant_ = {glm::dot(x_, from_eye), glm::dot(y_, from_eye)};
        w_constant_ = glm::dot(w_, from_eye);
        forward_ = glm::normalize(w_);
        first_depth_ = -glm::dot(forward_, from_eye);
    }
    const double sample = length_per_depth(size_.x / 2.0, size_.y / 2.0);
    if (!std::isfinite(sample) || !std::isfinite(forward_.x + forward_.y + forward_.z + constant_.x + constant_.y))
        throw InputError("the view's matrix maps space to less than an image");
}

SeenPoint PixelRays::seen(const glm::dvec3& point) const
{
    const glm::dvec3 p = point - reference_;
    return {glm::dot(x_, p), glm::dot(y_, p), glm::dot(w_, p), glm::dot(forward_, p)};
}

double PixelRays::length_per_depth(double px, double py) const
{
    const glm::dvec3 direction = glm::cross(glm::normalize(x_ - px * w_), glm::normalize(y_ - py * w_));
    return glm::length(direction) / std::abs(glm::dot(direction, forward_));
}

double PixelRays::depth_at(double px, double py, double normalised_z) const
{
    const glm::dvec4 point = clip_to_world_ * glm::dvec4(2 * px / size_.x - 1, 2 * py / size_.y - 1, normalised_z, 1);
    return glm::dot(forward_, glm::dvec3(point) / point.w - reference_);
}

} // namespace visorder::detail
