#pragma once

#include "visorder/box.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace visorder {

/// Where a scene is seen from.
struct View {
    glm::dvec4 eye;           ///< homogeneous, world coordinates: (position, 1), or (direction towards the viewer, 0)
    glm::dmat4 world_to_clip; ///< OpenGL clip space
    glm::ivec2 size;          ///< pixels
};

/// What VTK keeps in a vtkCamera. Angles in degrees.
struct Camera {
    glm::dvec3 position{0, 0, 1};
    glm::dvec3 focal_point{0, 0, 0};
    glm::dvec3 up{0, 1, 0};
    double view_angle = 30;    ///< vertical, of a perspective camera
    bool parallel = false;     ///< parallel projection along position - focal_point
    double parallel_scale = 1; ///< half the height of the view in world units, of a parallel camera
    double near = 0.01;        ///< distances of the clipping planes along the view direction
    double far = 1000;
};

/// The view of a camera. Throws InputError for a camera that shows nothing (position at the focal point, up along the
/// view, planes out of order, angle outside (0, 180), a number that is not finite) and for a size below 1 by 1.
View view_of(const Camera& camera, glm::ivec2 size);

/// Which way is up in a picture.
struct Upright {
    glm::dvec3 up{0, 1, 0};
    bool required = false; ///< whether a view along `up` is refused; else the y axis is up in it, or the z axis
};

/// The z axis for what is flat along it, as terrain is: four times as wide, or more, along x and y each. Else the y
/// axis.
Upright upright_for(const Box& bounds);

/// Perspective from `position` towards `target`, which must differ; `view_angle` is vertical, in degrees. Near and far
/// are placed to hold a sphere of `radius` around `target`. Throws InputError for an `upright` that is no direction, or
/// is required and lies along the view.
View look_at(glm::dvec3 position, glm::dvec3 target, double radius, double view_angle = 30,
             glm::ivec2 size = {512, 512}, const Upright& upright = {});

/// Parallel projection, the viewer infinitely far in direction `towards_viewer` of `target`; the view holds a sphere of
/// `radius` around `target`. Throws InputError for an `upright` as `look_at` does.
View parallel(glm::dvec3 towards_viewer, glm::dvec3 target, double radius, glm::ivec2 size = {512, 512},
              const Upright& upright = {});

/// Throws InputError for an eye that is NaN, infinite, or all zero.
void validate(const View& view);

} // namespace visorder
