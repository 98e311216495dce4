#include "checking/image_boxes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <oneapi/tbb/parallel_for.h>

namespace visorder::detail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// A number known to within an error.
struct Rounded {
    double value;
    double error;

    double low() const { return value - error; }
    double high() const { return value + error; }
};

glm::dvec3 unit(const glm::dvec3& v)
{
    const double largest = std::fmax(std::abs(v.x), std::fmax(std::abs(v.y), std::abs(v.z)));
    return largest > 0 ? glm::normalize(v / largest) : glm::dvec3(0, 0, 1);
}

// The axes of an image; what matters is only that every cell is put to the same three numbers.
struct Axes {
    glm::dvec3 right, up, forward;
};

Axes axes_of(const Scene& scene, const glm::dvec4& eye)
{
    Axes axes{};
    const glm::dvec3 from(eye);
    axes.forward = unit(eye.w == 0 ? -from : scene.bounds().middle() - from / eye.w);
    const glm::dvec3 aside = std::abs(axes.forward.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    axes.right = unit(glm::cross(axes.forward, aside));
    axes.up = glm::cross(axes.right, axes.forward);
    return axes;
}

// The axes are rounded, products and sums are: twenty times 2^-53 is more than all of that. Components of the axes may
// underflow, by less than 1e-321 each, which counts where coordinates are large in one direction and small in another.
// An underflow of a product adds no more than 1e-300.
Rounded dot(const glm::dvec3& axis, const glm::dvec3& v, const glm::dvec3& error)
{
    const glm::dvec3 size(std::abs(axis.x), std::abs(axis.y), std::abs(axis.z));
    const glm::dvec3 magnitude(std::abs(v.x), std::abs(v.y), std::abs(v.z));
    const double underflow = 1e-321 * (magnitude.x + magnitude.y + magnitude.z) + 1e-300;
    return {glm::dot(axis, v), 1e-14 * glm::dot(size, magnitude) + 1.001 * glm::dot(size, error) + underflow};
}

Box everything()
{
    Box box;
    box.min = glm::dvec3(-infinity);
    box.max = glm::dvec3(infinity);
    return box;
}

// The interval of a / b for b > 0, widened by the roundings of the division and of the bounds.
void add_quotient(const Rounded& a, const Rounded& b, double& low, double& high)
{
    const double smallest = std::fmin(a.low() / b.low(), a.low() / b.high());
    const double largest = std::fmax(a.high() / b.low(), a.high() / b.high());
    low = std::fmin(low, smallest - 1e-15 * std::abs(smallest) - 1e-300);
    high = std::fmax(high, largest + 1e-15 * std::abs(largest) + 1e-300);
}

Box box_of(const Mesh& mesh, CellId cell, const Axes& axes, const glm::dvec4& eye)
{
    Box box;
    for (PointId v : mesh.cell(cell)) {
        const glm::dvec3& p = mesh.points[v];
        glm::dvec3 seen = p, error(0);
        if (eye.w != 0) {
            seen = p * eye.w - glm::dvec3(eye);
            for (int c = 0; c < 3; ++c)
                error[c] = 3e-16 * (std::abs(p[c] * eye.w) + std::abs(seen[c])) + 1e-300;
        }
        const Rounded x = dot(axes.right, seen, error), y = dot(axes.up, seen, error),
                      z = dot(axes.forward, seen, error);
        const double sum = x.value + y.value + z.value + x.error + y.error + z.error;
        if (!std::isfinite(sum) || (eye.w != 0 && !(z.low() > 0)))
            return everything();
        box.min.z = std::fmin(box.min.z, z.low() - 1e-15 * std::abs(z.value));
        box.max.z = std::fmax(box.max.z, z.high() + 1e-15 * std::abs(z.value));
        const Rounded depth = eye.w != 0 ? z : Rounded{1, 0};
        add_quotient(x, depth, box.min.x, box.max.x);
        add_quotient(y, depth, box.min.y, box.max.y);
    }
    const bool finite = std::isfinite(box.min.x + box.min.y + box.min.z + box.max.x + box.max.y + box.max.z);
    return finite ? box : everything();
}

} // namespace

std::vector<Box> image_boxes(const Scene& scene, const glm::dvec4& eye)
{
    const Axes axes = axes_of(scene, eye);
    std::vector<Box> boxes(scene.cell_count());
    oneapi::tbb::parallel_for(CellId{0}, scene.cell_count(),
                              [&](CellId cell) { boxes[cell] = box_of(scene.mesh(), cell, axes, eye); });
    return boxes;
}

} // namespace visorder::detail
