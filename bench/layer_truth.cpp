#include "bench/layer_truth.h"

#include "visorder/box.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace visorder::bench {

namespace {

struct PixelRay {
    glm::dvec3 origin, direction; // of length 1
};

// Rays through the centres of pixels.
class PixelRays {
public:
    PixelRays(const View& view, glm::ivec2 size) : view_(view), size_(size), clip_to_world_(inverse(view.world_to_clip))
    {
    }

    PixelRay through(int x, int y) const
    {
        const glm::dvec2 at = 2.0 * (glm::dvec2(x, y) + 0.5) / glm::dvec2(size_) - 1.0;
        const glm::dvec3 target = world(glm::dvec4(at, 0, 1));
        if (view_.eye.w == 0)
            return {target, -glm::normalize(glm::dvec3(view_.eye))};
        const glm::dvec3 position = glm::dvec3(view_.eye) / view_.eye.w;
        return {position, glm::normalize(target - position)};
    }

private:
    glm::dvec3 world(const glm::dvec4& clip) const
    {
        const glm::dvec4 p = clip_to_world_ * clip;
        return glm::dvec3(p) / p.w;
    }

    const View& view_;
    glm::ivec2 size_;
    glm::dmat4 clip_to_world_;
};

// The distance along the ray at which it passes through the interior of a triangle, or NaN (Moeller, Trumbore 1997).
double meets(const PixelRay& ray, const std::array<glm::dvec3, 3>& corners, bool behind_too)
{
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec3 side = corners[1] - corners[0], other = corners[2] - corners[0];
    const glm::dvec3 p = glm::cross(ray.direction, other);
    const double determinant = glm::dot(side, p);
    if (determinant == 0)
        return none;
    const glm::dvec3 from_corner = ray.origin - corners[0];
    const double u = glm::dot(from_corner, p) / determinant;
    const glm::dvec3 q = glm::cross(from_corner, side);
    const double v = glm::dot(ray.direction, q) / determinant;
    constexpr double on_side = 1e-12; // rounded to either side of it
    if (!(u > on_side && v > on_side && u + v < 1 - on_side))
        return none;
    const double distance = glm::dot(other, q) / determinant;
    return behind_too || distance > 0 ? distance : none;
}

struct PixelBox {
    glm::ivec2 low{0}, high{0}; // from low up to high, without it
};

PixelBox pixels_of(const std::array<glm::dvec3, 3>& corners, const View& view, glm::ivec2 size)
{
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec3& corner : corners) {
        const glm::dvec4 clip = view.world_to_clip * glm::dvec4(corner, 1);
        if (!(clip.w > 0))
            return {glm::ivec2(0), size};
        const glm::dvec2 pixel = (glm::dvec2(clip) / clip.w + 1.0) / 2.0 * glm::dvec2(size);
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    return {glm::ivec2(glm::clamp(glm::floor(low), glm::dvec2(0), glm::dvec2(size))),
            glm::ivec2(glm::clamp(glm::ceil(high), glm::dvec2(0), glm::dvec2(size)))};
}

} // namespace

std::vector<TrueFragment> true_fragments(const Mesh& mesh, const View& view, glm::ivec2 size)
{
    const PixelRays rays(view, size);
    std::vector<PixelRay> of_pixels(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    const auto number = [&](int x, int y) {
        return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(size.x) + static_cast<std::uint32_t>(x);
    };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            of_pixels[number(x, y)] = rays.through(x, y);
    std::vector<TrueFragment> met;
    for (CellId triangle = 0; triangle < mesh.cell_count(); ++triangle) {
        const auto vertices = mesh.cell(triangle);
        const std::array corners{mesh.points[vertices[0]], mesh.points[vertices[1]], mesh.points[vertices[2]]};
        const PixelBox box = pixels_of(corners, view, size);
        for (int y = box.low.y; y < box.high.y; ++y)
            for (int x = box.low.x; x < box.high.x; ++x)
                if (const double distance = meets(of_pixels[number(x, y)], corners, view.eye.w == 0);
                    !std::isnan(distance))
                    met.push_back({number(x, y), triangle, distance});
    }
    std::sort(met.begin(), met.end(), [](const TrueFragment& a, const TrueFragment& b) {
        return a.pixel != b.pixel ? a.pixel < b.pixel : a.distance < b.distance;
    });
    return met;
}

double tie_distance(const Mesh& mesh)
{
    Box box;
    for (const glm::dvec3& point : mesh.points)
        box.add(point);
    return 0x1p-22 * glm::distance(box.min, box.max);
}

LayerCheck check_layers(const Mesh& mesh, const View& view, glm::ivec2 size, const Layers& layers,
                        const TriangleName& name)
{
    constexpr std::size_t most_witnesses = 5;
    const double tie = tie_distance(mesh);
    const std::vector<TrueFragment> met = true_fragments(mesh, view, size);
    std::vector<std::size_t> cycle(mesh.cell_count(), 0);
    for (std::size_t i = 0; i < layers.cycles.size(); ++i)
        for (CellId triangle : layers.cycles[i])
            cycle[triangle] = i + 1;

    LayerCheck result;
    result.fragments = met.size();
    const auto witness = [&](std::size_t& count, const TrueFragment& at, const std::string& what) {
        if (++count <= most_witnesses)
            result.witnesses.push_back(fmt::format("pixel {},{}: {}", at.pixel % static_cast<std::uint32_t>(size.x),
                                                   at.pixel / static_cast<std::uint32_t>(size.x), what));
    };
    for (std::size_t begin = 0, end = 0; begin < met.size(); begin = end) {
        ++result.samples;
        while (end < met.size() && met[end].pixel == met[begin].pixel)
            ++end;
        for (std::size_t b = begin; b < end; ++b) {
            const CellId back = met[b].triangle;
            if (layers.layer[back] == 0)
                witness(result.missed, met[b], fmt::format("{} covers it, but has no layer", name(back)));
            for (std::size_t f = begin; f < b; ++f) {
                const CellId front = met[f].triangle;
                if (met[b].distance - met[f].distance <= tie)
                    ++result.ties;
                else if (cycle[front] != 0 && cycle[front] == cycle[back])
                    ++result.in_cycles;
                else if (++result.pairs; layers.layer[front] >= layers.layer[back])
                    witness(result.wrong, met[b],
                            fmt::format("{} lies in front of {}, by {}, with layers {} and {}", name(front), name(back),
                                        met[b].distance - met[f].distance, layers.layer[front], layers.layer[back]));
            }
        }
    }
    return result;
}

} // namespace visorder::bench
