#include "bench/painting.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace visorder::bench {

namespace {

// Dark blue over teal and sand to red, in linear steps.
glm::dvec3 colour_of(double t)
{
    constexpr glm::dvec3 stops[] = {{0.10, 0.15, 0.40}, {0.10, 0.55, 0.60}, {0.95, 0.85, 0.55}, {0.80, 0.20, 0.15}};
    const double x = std::clamp(t, 0.0, 1.0) * 3;
    const int i = std::min(static_cast<int>(x), 2);
    return glm::mix(stops[i], stops[i + 1], x - i);
}

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The convex hull, counterclockwise (Andrew 1979).
std::vector<glm::dvec2> hull_of(std::vector<glm::dvec2> points)
{
    std::sort(points.begin(), points.end(),
              [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<glm::dvec2> hull;
    for (int half = 0; half < 2; ++half) {
        const std::size_t start = hull.size();
        for (const glm::dvec2& p : points) {
            while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

void fill(Image& image, const std::vector<glm::dvec2>& hull, const glm::dvec3& colour, double opacity)
{
    if (hull.size() < 3)
        return;
    double low = hull[0].y, high = hull[0].y;
    for (const glm::dvec2& p : hull) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    const int first = std::max(0, static_cast<int>(std::ceil(low - 0.5)));
    const int last = std::min(image.size.y - 1, static_cast<int>(std::floor(high - 0.5)));
    for (int y = first; y <= last; ++y) {
        double left = image.size.x, right = 0;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const glm::dvec2& a = hull[i];
            const glm::dvec2& b = hull[(i + 1) % hull.size()];
            const double at = y + 0.5;
            if ((a.y <= at) == (b.y <= at))
                continue;
            const double x = a.x + (at - a.y) / (b.y - a.y) * (b.x - a.x);
            left = std::min(left, x);
            right = std::max(right, x);
        }
        const int begin = std::max(0, static_cast<int>(std::ceil(left - 0.5)));
        const int end = std::min(image.size.x, static_cast<int>(std::floor(right - 0.5)) + 1);
        for (int x = begin; x < end; ++x) {
            glm::vec4& pixel = image.pixels[image.index(x, y)];
            pixel = glm::mix(pixel, glm::vec4(colour, 1), static_cast<float>(opacity));
        }
    }
}

template <class Colour>
Image painted(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view, double opacity,
              const Colour& colour)
{
    Image image{view.size, {}};
    image.pixels.assign(static_cast<std::size_t>(view.size.x * view.size.y), glm::vec4(1));
    for (CellId cell : back_to_front) {
        std::vector<glm::dvec2> corners;
        for (PointId p : mesh.cell(cell)) {
            const glm::dvec4 clip = view.world_to_clip * glm::dvec4(mesh.points[p], 1);
            if (clip.w <= 0)
                break;
            corners.emplace_back((clip.x / clip.w + 1) / 2 * view.size.x, (clip.y / clip.w + 1) / 2 * view.size.y);
        }
        if (corners.size() == mesh.cell(cell).size())
            fill(image, hull_of(corners), colour(cell), opacity);
    }
    return image;
}

} // namespace

Image paint(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view, double opacity)
{
    return painted(mesh, back_to_front, view, opacity, [&](CellId cell) {
        double scalar = 0;
        for (PointId p : mesh.cell(cell))
            scalar += mesh.scalars.empty() ? 0.5 : static_cast<double>(mesh.scalars[p]);
        return colour_of(scalar / static_cast<double>(mesh.cell(cell).size()));
    });
}

Image paint(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view,
            std::span<const glm::dvec3> colours)
{
    return painted(mesh, back_to_front, view, 1, [&](CellId cell) {
        const glm::dvec3& a = mesh.points[mesh.cell(cell)[0]];
        const glm::dvec3 normal = glm::cross(mesh.points[mesh.cell(cell)[1]] - a, mesh.points[mesh.cell(cell)[2]] - a);
        const glm::dvec3 towards = glm::dvec3(view.eye) - view.eye.w * a;
        const double lengths = glm::length(normal) * glm::length(towards);
        const double facing = lengths > 0 ? std::abs(glm::dot(normal, towards)) / lengths : 0;
        return colours[cell] * (0.55 + 0.45 * facing);
    });
}

Image side_by_side(std::span<const Image> pictures, int gap)
{
    Image result{{-gap, pictures.front().size.y}, {}};
    for (const Image& image : pictures)
        result.size.x += image.size.x + gap;
    result.pixels.assign(static_cast<std::size_t>(result.size.x * result.size.y), glm::vec4(1));
    int left = 0;
    for (const Image& image : pictures) {
        for (int y = 0; y < image.size.y; ++y)
            std::copy_n(image.pixels.begin() + y * image.size.x, image.size.x,
                        result.pixels.begin() + y * result.size.x + left);
        left += image.size.x + gap;
    }
    return result;
}

} // namespace visorder::bench
