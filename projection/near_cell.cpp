#include "projection/near_cell.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace visorder {

namespace {

// Pixels that the cell may cover: around its points where all are before the eye, else all of the image.
void bound(const Screen& screen, const std::array<glm::dvec3, 4>& points, NearCell& cell)
{
    const glm::dvec2 low = -glm::dvec2(screen.centre());
    const glm::dvec2 high = glm::dvec2(screen.size() - screen.centre());
    glm::dvec2 first = high;
    glm::dvec2 last = low;
    for (const glm::dvec3& point : points) {
        const ScreenPoint p = screen.seen(point);
        if (!(p.w > 0) || !std::isfinite(p.x) || !std::isfinite(p.y)) {
            first = low;
            last = high;
            break;
        }
        first = glm::min(first, glm::dvec2(p.x, p.y));
        last = glm::max(last, glm::dvec2(p.x, p.y));
    }
    cell.low = glm::ivec2(glm::clamp(glm::floor(first), low, high));
    cell.high = glm::ivec2(glm::clamp(glm::ceil(last), low, high));
}

} // namespace

std::optional<NearCell> near_cell(const Screen& screen, const std::array<glm::dvec3, 4>& points,
                                  const std::array<float, 4>& scalars)
{
    std::array<glm::dvec3, 4> from;
    for (std::size_t i = 0; i < 4; ++i)
        from[i] = points[i] - screen.reference();
    const glm::dmat3& rays = screen.rays();
    const glm::dmat3& origins = screen.origins();
    // The linear form (x, y, 1) -> normal . (m (x, y, 1)) for a matrix of columns.
    const auto form = [](const glm::dvec3& normal, const glm::dmat3& m) { return normal * m; };

    NearCell cell;
    glm::dvec3 gradient(0);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3& a = from[(i + 1) % 4];
        glm::dvec3 normal = glm::cross(from[(i + 2) % 4] - a, from[(i + 3) % 4] - a);
        double height = glm::dot(normal, from[i] - a);
        if (height == 0 || !std::isfinite(height))
            return std::nullopt;
        // Barycentric coordinate i is (normal . (x - a)) / height. As a face, of unit length, it points outwards.
        gradient += normal / height * static_cast<double>(scalars[i]);
        const double scale = (height > 0 ? -1 : 1) / glm::length(normal);
        normal *= scale;
        glm::dvec3 offset = form(normal, origins);
        offset.z -= glm::dot(normal, a);
        cell.offsets[i] = glm::vec3(offset);
        cell.slopes[i] = glm::vec3(form(normal, rays));
    }
    glm::dvec3 scalar_offset = form(gradient, origins);
    scalar_offset.z += static_cast<double>(scalars[0]) - glm::dot(gradient, from[0]);
    cell.scalar_offset = glm::vec3(scalar_offset);
    cell.scalar_slope = glm::vec3(form(gradient, rays));
    cell.scalar_range = {*std::min_element(scalars.begin(), scalars.end()),
                         *std::max_element(scalars.begin(), scalars.end())};
    bound(screen, points, cell);
    if (cell.low.x >= cell.high.x || cell.low.y >= cell.high.y)
        return std::nullopt;
    return cell;
}

} // namespace visorder
