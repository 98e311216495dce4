#include "files/image_file.h"

#include "optics/srgb.h"
#include "visorder/error.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <algorithm>
#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <fstream>
#include <png.h>
#include <utility>

namespace visorder::detail {

namespace {

constexpr std::pair<const char*, int> channels[] = {{"R", 0}, {"G", 1}, {"B", 2}, {"A", 3}};

/// OpenEXR stores rows from the top down; taking them from the bottom up again is its own inverse.
Image upside_down(const Image& image)
{
    Image result{image.size, {}};
    result.pixels.reserve(image.pixels.size());
    for (int y = image.size.y; y-- > 0;) {
        const auto row = image.pixels.begin() + static_cast<std::ptrdiff_t>(image.index(0, y));
        result.pixels.insert(result.pixels.end(), row, row + image.size.x);
    }
    return result;
}

/// Where OpenEXR finds the channels of an image whose first pixel it counts as (left, top).
Imf::FrameBuffer frame_buffer(Image& image, int left, int top)
{
    Imf::FrameBuffer buffer;
    const auto row = sizeof(glm::vec4) * static_cast<std::size_t>(image.size.x);
    for (const auto& [name, component] : channels)
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, &image.pixels.front()[component], {left, top}, image.size.x,
                                             image.size.y, sizeof(glm::vec4), row, 1, 1, component == 3 ? 1.0 : 0.0));
    return buffer;
}

void write_bytes(const std::string& bytes, const std::filesystem::path& file)
{
    std::ofstream out(file, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!out.flush())
        throw InputError(fmt::format("{}: cannot be written", file.string()));
}

} // namespace

std::string png_of(const Image& image, const PngStyle& style)
{
    std::vector<png_byte> bytes;
    bytes.reserve(image.pixels.size() * 3);
    for (const glm::vec4& pixel : upside_down(image).pixels)
        for (int k = 0; k < 3; ++k) {
            const float over = pixel[k] + (1 - pixel.a) * style.background[k];
            const double value = std::clamp(static_cast<double>(over), 0.0, 1.0);
            bytes.push_back(static_cast<png_byte>(std::lround((style.to_srgb ? srgb_of_linear(value) : value) * 255)));
        }
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.size.x);
    png.height = static_cast<png_uint_32>(image.size.y);
    png.format = PNG_FORMAT_RGB;
    png_alloc_size_t length = 0;
    std::string file;
    if (png_image_write_to_memory(&png, nullptr, &length, 0, bytes.data(), 0, nullptr) != 0) {
        file.resize(length);
        if (png_image_write_to_memory(&png, file.data(), &length, 0, bytes.data(), 0, nullptr) != 0) {
            file.resize(length);
            return file;
        }
    }
    throw InputError(
        fmt::format("a picture of {} x {} cannot be made a PNG: {}", image.size.x, image.size.y, png.message));
}

std::string exr_of(const Image& image)
{
    try {
        Imf::Header header(image.size.x, image.size.y);
        for (const auto& [name, component] : channels)
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        Image rows = upside_down(image);
        Imf::StdOSStream stream;
        {
            Imf::OutputFile output(stream, header);
            output.setFrameBuffer(frame_buffer(rows, 0, 0));
            output.writePixels(image.size.y);
        }
        return stream.str();
    } catch (const std::exception& error) {
        throw InputError(fmt::format("a picture of {} x {} cannot be made an OpenEXR file: {}", image.size.x,
                                     image.size.y, error.what()));
    }
}

void write_png(const Image& image, const std::filesystem::path& file, const PngStyle& style)
{
    write_bytes(png_of(image, style), file);
}

void write_exr(const Image& image, const std::filesystem::path& file)
{
    write_bytes(exr_of(image), file);
}

Image read_exr(const std::filesystem::path& file)
{
    try {
        Imf::InputFile input(file.c_str());
        for (const char* name : {"R", "G", "B"})
            if (input.header().channels().findChannel(name) == nullptr)
                throw InputError(fmt::format("it has no channel {}", name));
        const auto& window = input.header().dataWindow();
        Image image{{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1}, {}};
        image.pixels.resize(static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.size.y));
        input.setFrameBuffer(frame_buffer(image, window.min.x, window.min.y));
        input.readPixels(window.min.y, window.max.y);
        return upside_down(image);
    } catch (const std::exception& error) {
        throw InputError(fmt::format("{}: cannot be read: {}", file.string(), error.what()));
    }
}

} // namespace visorder::detail
