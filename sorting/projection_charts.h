#pragma once

#include "scene/box.h"

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

namespace visorder {

/// Maps of the rays from an eye to a plane, together of all of them: one plane along a direction, and the sides of a
/// cube around a position, as many of the six as may show something of the scene. Points on one ray have the same first
/// two coordinates in a chart; the third grows along the ray. Boxes in charts find the pairs of faces that may cover
/// each other; they are rounded outward, so that none is lost.
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

private:
    void set_direction(const glm::dvec3& towards, const Box& bounds);
    void set_position(const glm::dvec4& eye, const Box& bounds);
    std::optional<Box> box_along_direction(std::span<const glm::dvec3> face) const;
    std::optional<Box> box_in_side(std::span<const glm::dvec3> face, int side) const;

    bool parallel_;
    int count_ = 1;
    std::array<int, 6> sides_{}; // of the cube, those that may show something
    glm::dvec3 origin_{};
    glm::dvec3 right_{}, up_{}, away_{};
    double margin_ = 0; // along a direction: of every image; around a position: of the position's coordinates
};

} // namespace visorder
