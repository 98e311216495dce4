#pragma once

#include "visorder/image.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace visorder::detail {

/// How far two images are apart, over all four channels of their pixels, which are linear and in [0, 1]: red, green and
/// blue as seen over black, and alpha, which tells how they would differ over anything else.
struct ImageErrors {
    std::size_t pixels = 0;      ///< those that were compared
    double root_mean_square = 0; ///< over pixels and channels
    double mean_absolute = 0;    ///< likewise
    double largest = 0;          ///< of a channel of a pixel
    double beyond_one_level = 0; ///< share of the pixels of which a channel differs by more than 1/255
    glm::ivec2 largest_at{-1};   ///< the first pixel with that difference; (-1, -1) if all are equal
};

/// Compares two images. Where `left_out` is given (one value a pixel), pixels for which it is not 0 do not count. A
/// pixel with a channel that is not a number differs infinitely. Throws InputError for images of different sizes, a
/// mask that does not fit, and if no pixels are left.
ImageErrors image_errors(const Image& a, const Image& b, std::span<const std::uint8_t> left_out = {});

/// Shows where two images differ: white where they are equal, and the redder the larger the largest difference of a
/// pixel's channels, times `amplification`, is; dark red from 1 on. Colours are for display as they are. Throws
/// InputError for images of different sizes.
Image difference_image(const Image& a, const Image& b, double amplification);

} // namespace visorder::detail
