#include "checking/image_errors.h"

#include "visorder/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <limits>

namespace visorder::detail {

namespace {

void require_equal_sizes(const Image& a, const Image& b)
{
    if (a.size != b.size)
        throw InputError(fmt::format("images of {} x {} and {} x {} pixels cannot be compared", a.size.x, a.size.y,
                                     b.size.x, b.size.y));
}

std::array<double, 4> differences(const glm::vec4& a, const glm::vec4& b)
{
    std::array<double, 4> result{};
    for (int k = 0; k < 4; ++k) {
        const double d = std::abs(static_cast<double>(a[k]) - static_cast<double>(b[k]));
        result[static_cast<std::size_t>(k)] = std::isnan(d) ? std::numeric_limits<double>::infinity() : d;
    }
    return result;
}

} // namespace

ImageErrors image_errors(const Image& a, const Image& b, std::span<const std::uint8_t> left_out)
{
    require_equal_sizes(a, b);
    if (!left_out.empty() && left_out.size() != a.pixels.size())
        throw InputError(
            fmt::format("a mask of {} values does not fit images of {} pixels", left_out.size(), a.pixels.size()));
    ImageErrors errors;
    double squares = 0;
    std::size_t beyond = 0;
    for (int y = 0; y < a.size.y; ++y)
        for (int x = 0; x < a.size.x; ++x) {
            const std::size_t i = a.index(x, y);
            if (!left_out.empty() && left_out[i] != 0)
                continue;
            ++errors.pixels;
            const auto channels = differences(a.pixels[i], b.pixels[i]);
            for (const double d : channels) {
                squares += d * d;
                errors.mean_absolute += d;
            }
            const double most = *std::max_element(channels.begin(), channels.end());
            if (most > 1.0 / 255)
                ++beyond;
            if (most > errors.largest) {
                errors.largest = most;
                errors.largest_at = {x, y};
            }
        }
    if (errors.pixels == 0)
        throw InputError("no pixels of the images are left to compare");
    const double values = 4 * static_cast<double>(errors.pixels);
    errors.root_mean_square = std::sqrt(squares / values);
    errors.mean_absolute /= values;
    errors.beyond_one_level = static_cast<double>(beyond) / static_cast<double>(errors.pixels);
    return errors;
}

Image difference_image(const Image& a, const Image& b, double amplification)
{
    require_equal_sizes(a, b);
    Image result{a.size, std::vector<glm::vec4>(a.pixels.size())};
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const auto channels = differences(a.pixels[i], b.pixels[i]);
        const double most = std::min(1.0, *std::max_element(channels.begin(), channels.end()) * amplification);
        result.pixels[i] = glm::mix(glm::vec4(1), glm::vec4(0.7f, 0, 0, 1), static_cast<float>(most));
    }
    return result;
}

} // namespace visorder::detail
