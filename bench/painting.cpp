#include "bench/painting.h"

#include "scene/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <png.h>

namespace visorder {

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

void fill(Picture& picture, const std::vector<glm::dvec2>& hull, const glm::dvec3& colour, double opacity)
{
    if (hull.size() < 3)
        return;
    double low = hull[0].y, high = hull[0].y;
    for (const glm::dvec2& p : hull) {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    const int first = std::max(0, static_cast<int>(std::ceil(low - 0.5)));
    const int last = std::min(picture.size.y - 1, static_cast<int>(std::floor(high - 0.5)));
    for (int y = first; y <= last; ++y) {
        double left = picture.size.x, right = 0;
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
        const int end = std::min(picture.size.x, static_cast<int>(std::floor(right - 0.5)) + 1);
        for (int x = begin; x < end; ++x) {
            glm::dvec3& pixel = picture.pixels[static_cast<std::size_t>(y * picture.size.x + x)];
            pixel = glm::mix(pixel, colour, opacity);
        }
    }
}

template <class Colour>
Picture painted(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view, double opacity,
                const Colour& colour)
{
    Picture picture{view.size, {}};
    picture.pixels.assign(static_cast<std::size_t>(view.size.x * view.size.y), glm::dvec3(1));
    for (CellId cell : back_to_front) {
        std::vector<glm::dvec2> corners;
        for (PointId p : mesh.cell(cell)) {
            const glm::dvec4 clip = view.world_to_clip * glm::dvec4(mesh.points[p], 1);
            if (clip.w <= 0)
                break;
            corners.emplace_back((clip.x / clip.w + 1) / 2 * view.size.x, (1 - clip.y / clip.w) / 2 * view.size.y);
        }
        if (corners.size() == mesh.cell(cell).size())
            fill(picture, hull_of(corners), colour(cell), opacity);
    }
    return picture;
}

} // namespace

Picture paint(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view, double opacity)
{
    return painted(mesh, back_to_front, view, opacity, [&](CellId cell) {
        double scalar = 0;
        for (PointId p : mesh.cell(cell))
            scalar += mesh.scalars.empty() ? 0.5 : static_cast<double>(mesh.scalars[p]);
        return colour_of(scalar / static_cast<double>(mesh.cell(cell).size()));
    });
}

Picture paint(const Mesh& mesh, std::span<const CellId> back_to_front, const View& view,
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

Picture difference(const Picture& a, const Picture& b, double amplification)
{
    Picture result{a.size, std::vector<glm::dvec3>(a.pixels.size())};
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const glm::dvec3 d = glm::abs(a.pixels[i] - b.pixels[i]) * amplification;
        const double most = std::min(1.0, std::max({d.x, d.y, d.z}));
        result.pixels[i] = glm::mix(glm::dvec3(1), glm::dvec3(0.7, 0, 0), most);
    }
    return result;
}

Picture side_by_side(std::span<const Picture> pictures, int gap)
{
    Picture result{{-gap, pictures.front().size.y}, {}};
    for (const Picture& picture : pictures)
        result.size.x += picture.size.x + gap;
    result.pixels.assign(static_cast<std::size_t>(result.size.x * result.size.y), glm::dvec3(1));
    int left = 0;
    for (const Picture& picture : pictures) {
        for (int y = 0; y < picture.size.y; ++y)
            std::copy_n(picture.pixels.begin() + y * picture.size.x, picture.size.x,
                        result.pixels.begin() + y * result.size.x + left);
        left += picture.size.x + gap;
    }
    return result;
}

void write_png(const Picture& picture, const std::filesystem::path& file)
{
    std::vector<png_byte> bytes;
    bytes.reserve(picture.pixels.size() * 3);
    for (const glm::dvec3& pixel : picture.pixels)
        for (int k = 0; k < 3; ++k)
            bytes.push_back(static_cast<png_byte>(std::lround(std::clamp(pixel[k], 0.0, 1.0) * 255)));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.size.x);
    image.height = static_cast<png_uint_32>(picture.size.y);
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&image, file.c_str(), 0, bytes.data(), 0, nullptr) == 0)
        throw InputError(fmt::format("{}: cannot be written: {}", file.string(), image.message));
}

} // namespace visorder
