#include "files/image_file.h"
#include "optics/srgb.h"
#include "tests/temporary_folder.h"
#include "visorder/error.h"

#include <array>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <limits>
#include <png.h>
#include <string>
#include <vector>

namespace visorder::tests {

using namespace detail;

namespace {

using testing::HasSubstr;

Image sample()
{
    Image image{{3, 2}, {}};
    image.pixels = {{0.1f, 0.2f, 0.3f, 0.4f},
                    {-1, 2, 1e-30f, 1},
                    {0, 0, 0, 0},
                    {1, 1, 1, 1},
                    {0.25f, 0, 0.5f, 0.5f},
                    {std::numeric_limits<float>::infinity(), 1e30f, 0, 1}};
    return image;
}

struct Bytes {
    glm::ivec2 size;
    std::vector<std::array<int, 3>> rgb; // from the top down
};

Bytes read_png(const std::filesystem::path& file)
{
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&png, file.c_str()) == 0)
        return {};
    EXPECT_EQ(png.format & PNG_FORMAT_FLAG_ALPHA, 0U);
    png.format = PNG_FORMAT_RGB;
    std::vector<png_byte> bytes(PNG_IMAGE_SIZE(png));
    Bytes result{{png.width, png.height}, {}};
    if (png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) == 0)
        return {};
    for (std::size_t i = 0; i < bytes.size(); i += 3)
        result.rgb.push_back({bytes[i], bytes[i + 1], bytes[i + 2]});
    return result;
}

std::string fault(const std::function<void()>& act)
{
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(OpenExr, KeepsEveryBit)
{
    const TemporaryFolder folder;
    write_exr(sample(), folder.file("a.exr"));
    const Image back = read_exr(folder.file("a.exr"));
    EXPECT_EQ(back.size, sample().size);
    EXPECT_EQ(back.pixels, sample().pixels);
}

TEST(OpenExr, NamesTheFileThatCannotBeWrittenOrRead)
{
    const TemporaryFolder folder;
    const std::filesystem::path nowhere = folder.file("no/folder.exr");
    EXPECT_THAT(fault([&] { write_exr(sample(), nowhere); }), HasSubstr(nowhere.string() + ": cannot be written"));
    EXPECT_THAT(fault([&] { read_exr(nowhere); }), HasSubstr(nowhere.string() + ": cannot be read"));
    EXPECT_THAT(fault([&] { read_exr(folder.write("b.exr", "no image")); }), HasSubstr("b.exr: cannot be read"));
}

TEST(Png, ShowsTheImageUprightOverItsBackground)
{
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.file("a.png");
    write_png(sample(), file, {.background = {1, 0, 0.5f}, .to_srgb = false});
    const Bytes bytes = read_png(file);
    ASSERT_EQ(bytes.size, glm::ivec2(3, 2));
    const std::vector<std::array<int, 3>> expected{{255, 255, 255}, {191, 0, 191}, {255, 255, 0},
                                                   {179, 51, 153},  {0, 255, 0},   {255, 0, 128}};
    EXPECT_EQ(bytes.rgb, expected);
}

TEST(Png, StoresSrgbUnlessToldNotTo)
{
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.file("a.png");
    Image image{{256, 1}, {}};
    for (int i = 0; i < 256; ++i) {
        const auto linear = static_cast<float>(linear_of_srgb(i / 255.0));
        image.pixels.emplace_back(linear, linear, linear, 1);
    }
    write_png(image, file);
    const Bytes bytes = read_png(file);
    ASSERT_EQ(bytes.rgb.size(), 256U);
    for (int i = 0; i < 256; ++i)
        EXPECT_EQ(bytes.rgb[static_cast<std::size_t>(i)][0], i);
}

TEST(Png, NamesTheFileThatCannotBeWritten)
{
    const TemporaryFolder folder;
    const std::filesystem::path nowhere = folder.file("no/folder.png");
    EXPECT_THAT(fault([&] { write_png(sample(), nowhere); }), HasSubstr(nowhere.string() + ": cannot be written"));
}

} // namespace
} // namespace visorder::tests
