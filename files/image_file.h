#pragma once

#include "visorder/image.h"

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>

namespace visorder::detail {

/// How a linear image is shown in a PNG file.
struct PngStyle {
    glm::vec3 background{1}; ///< linear; the image is laid over it
    /// Whether to store sRGB, which is what viewers take the numbers in a PNG for. Else they are stored as they are:
    /// for pictures that were made of such numbers.
    bool to_srgb = true;
};

/// An image as the content of a PNG or an OpenEXR file, as the functions below write it. Throws InputError for a size
/// that the format cannot hold.
std::string png_of(const Image& image, const PngStyle& style = {});
std::string exr_of(const Image& image);

/// Writes an image as PNG, 8 bits per channel, no alpha. What is outside [0, 1] is cut off. Throws InputError, naming
/// the file, where it cannot be written.
void write_png(const Image& image, const std::filesystem::path& file, const PngStyle& style = {});

/// Writes an image as OpenEXR: channels R, G, B, A in single precision, linear and premultiplied as they are. Throws
/// InputError, naming the file, where it cannot be written.
void write_exr(const Image& image, const std::filesystem::path& file);

/// Reads an OpenEXR file of channels R, G, B and maybe A (else 1), of any precision. Throws InputError, naming the
/// file, where it cannot be read or has no such channels.
Image read_exr(const std::filesystem::path& file);

} // namespace visorder::detail
