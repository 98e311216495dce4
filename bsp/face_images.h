#pragma once

#include "bsp/face_corners.h"
#include "geometry/projection_charts.h"
#include "visorder/box.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace visorder::detail {

/// How the images of two faces lie, where rounded images tell it for sure.
enum class Shared { nothing, area, unknown };

/// The images of the faces of a BSP tree in one plane, in double precision, each corner's computed once.
class FaceImages {
public:
    /// `corners` must live as long as this.
    explicit FaceImages(const FaceCorners& corners) : corners_(corners) {}

    /// From an eye whose charts have images. On all threads.
    void project(const ProjectionCharts& charts);

    /// Holds the image of a face; as ProjectionCharts::box.
    Box box(std::uint32_t face) const;

    /// Whether the images of two faces share an area. Corners in common are known to be the same.
    Shared shared(std::uint32_t f, std::uint32_t g) const;

    /// The same of two faces that have corner i of f, which is corner k of g, in common and no other. Where they share
    /// an area, its two sides at that corner are sides of theirs: `sides` has bits of the corners at the other ends, as
    /// TouchingFaces::Touching, if that is known for sure, else none.
    struct SharedAngle {
        Shared shared;
        unsigned sides;
    };
    SharedAngle shared_at(std::uint32_t f, std::size_t i, std::uint32_t g, std::size_t k) const;

    std::size_t bytes() const { return images_.capacity() * sizeof(glm::dvec2) + depths_.capacity() * sizeof(double); }

private:
    struct Polygon;
    Polygon polygon(std::uint32_t face) const;
    double turn_bound(double size) const;
    static Shared outside(const Polygon& polygon, const Polygon& other, unsigned ends, double bound);

    const FaceCorners& corners_;
    std::vector<glm::dvec2> images_; // a corner
    std::vector<double> depths_;
    glm::dvec3 error_{};
};

} // namespace visorder::detail
