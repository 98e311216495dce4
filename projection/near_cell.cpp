#include "projection/near_cell.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>

namespace visorder::detail {

namespace {

struct PixelBox {
    glm::dvec2 low, high;
};

PixelBox image_of(const Screen& screen)
{
    return {-glm::dvec2(screen.centre()), glm::dvec2(screen.size() - screen.centre())};
}

// Around places that are all before the eye, else all of the image.
PixelBox box_of(const Screen& screen, const std::array<glm::dvec3, 4>& places)
{
    const PixelBox image = image_of(screen);
    PixelBox box{image.high, image.low};
    for (const glm::dvec3& place : places) {
        const glm::dvec2 pixel = glm::dvec2(place.x, place.y) / place.z;
        if (!(place.z > 0) || !std::isfinite(pixel.x) || !std::isfinite(pixel.y))
            return image;
        box.low = glm::min(box.low, pixel);
        box.high = glm::max(box.high, pixel);
    }
    return box;
}

std::optional<NearCell> bounded(NearCell cell, const Screen& screen, const std::array<double, 4>& scalars)
{
    cell.scalar_range = {*std::min_element(scalars.begin(), scalars.end()),
                         *std::max_element(scalars.begin(), scalars.end())};
    const PixelBox image = image_of(screen);
    const PixelBox box = box_of(screen, cell.places);
    cell.low = glm::ivec2(glm::clamp(glm::floor(box.low), image.low, image.high));
    cell.high = glm::ivec2(glm::clamp(glm::ceil(box.high), image.low, image.high));
    if (cell.low.x >= cell.high.x || cell.low.y >= cell.high.y)
        return std::nullopt;
    return cell;
}

constexpr double infinitely_far = -1e300;

} // namespace

NearCellRecord record_of(const NearCell& cell)
{
    NearCellRecord record{};
    std::size_t next = 0;
    const auto put = [&](double number) { record[next++] = number; };
    for (const glm::dvec3& place : cell.places)
        for (const double coordinate : {place.x, place.y, place.z})
            put(coordinate);
    for (const glm::dvec2& value : cell.values) {
        put(value.x);
        put(value.y);
    }
    put(cell.scalar_range.x);
    put(cell.scalar_range.y);
    put(cell.first_depth);
    put(cell.inverse_distance);
    for (const int bound : {cell.low.x, cell.low.y, cell.high.x, cell.high.y})
        put(bound);
    return record;
}

std::optional<NearCell> near_cell(const Screen& screen, const std::array<glm::dvec3, 4>& points,
                                  const std::array<double, 4>& scalars)
{
    NearCell cell{};
    for (std::size_t i = 0; i < 4; ++i) {
        const Screen::Anywhere p = screen.anywhere(points[i]);
        cell.places[i] = p.place;
        cell.values[i] = {p.depth, scalars[i]};
    }
    cell.inverse_distance = 0;
    cell.first_depth = screen.perspective() ? 0 : infinitely_far;
    return bounded(cell, screen, scalars);
}

std::optional<NearCell> near_cell_on_screen(const Screen& screen, const std::array<glm::dvec3, 4>& at,
                                            const std::array<double, 4>& scalars)
{
    NearCell cell{};
    for (std::size_t i = 0; i < 4; ++i) {
        cell.places[i] = {at[i].x, at[i].y, 1};
        cell.values[i] = {at[i].z, scalars[i] * (1 - at[i].z * screen.inverse_distance())};
    }
    cell.inverse_distance = screen.inverse_distance();
    cell.first_depth = infinitely_far;
    return bounded(cell, screen, scalars);
}

} // namespace visorder::detail
