#pragma once

#include "visorder/box.h"

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

namespace visorder::detail {

/// Maps of the rays from an eye to a plane, together of all of them: one plane along a direction and from a position
/// that has the scene well in front of it, and the sides of a cube around any other position, as many of the six as may
/// show something of the scene. Points on one ray have the same first two coordinates in a chart; the third grows along
/// the ray. Boxes in charts find the pairs of faces that may cover each other; they are rounded outward, so that none
/// is lost.
///
/// Immutable; any number of threads may use it.
class ProjectionCharts {
public:
    /// `bounds` holds all faces that will be asked for.
    ProjectionCharts(const Box& bounds, const glm::dvec4& eye);

    int count() const { return count_; }

    /// A box that holds the image of the part of a convex face, of up to four vertices, that chart `chart` shows, if
    /// there may be any.
    std::optional<Box> box(std::span<const glm::dvec3> face, int chart) const;

    /// Whether one plane shows every point of the scene; then `image` may be asked for. A face's image is the convex
    /// polygon between those of its vertices.
    bool has_images() const { return in_one_plane_; }
    /// The image of a point within the bounds, rounded: some map as above, which does not depend on the point, takes it
    /// to less than `image_error` off along each of the three axes.
    glm::dvec3 image(const glm::dvec3& point) const
    {
        const glm::dvec3 d = point - origin_;
        const glm::dvec3 along(glm::dot(right_, d), glm::dot(up_, d), glm::dot(away_, d));
        return parallel_ ? along : glm::dvec3(along.x / along.z, along.y / along.z, along.z);
    }
    const glm::dvec3& image_error() const { return image_error_; }

private:
    void set_axes(const glm::dvec3& towards);
    void set_direction(const glm::dvec3& towards, const Box& bounds);
    void set_position(const glm::dvec4& eye, const Box& bounds);
    bool set_plane(const Box& bounds);
    void set_sides(const Box& bounds);
    std::optional<Box> box_in_side(std::span<const glm::dvec3> face, int side) const;

    bool parallel_;
    bool in_one_plane_ = false;
    int count_ = 1;
    std::array<int, 6> sides_{}; // of the cube, those that may show something
    glm::dvec3 origin_{};
    glm::dvec3 right_{}, up_{}, away_{};
    glm::dvec3 image_error_{};
    double margin_ = 0; // of the position's coordinates
};

} // namespace visorder::detail
