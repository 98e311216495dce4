#include "checking/image_errors.h"
#include "visorder/error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace visorder::tests {

using namespace detail;
namespace {

Image grey(glm::ivec2 size, float value)
{
    return {size, std::vector<glm::vec4>(static_cast<std::size_t>(size.x * size.y), glm::vec4(value))};
}

TEST(ImageErrors, AreZeroForEqualImages)
{
    const ImageErrors errors = image_errors(grey({3, 2}, 0.5f), grey({3, 2}, 0.5f));
    EXPECT_EQ(errors.pixels, 6U);
    EXPECT_EQ(errors.root_mean_square, 0);
    EXPECT_EQ(errors.mean_absolute, 0);
    EXPECT_EQ(errors.largest, 0);
    EXPECT_EQ(errors.beyond_one_level, 0);
    EXPECT_EQ(errors.largest_at, glm::ivec2(-1));
}

TEST(ImageErrors, CountAllFourChannels)
{
    for (int channel = 0; channel < 4; ++channel) {
        const Image a = grey({5, 2}, 0);
        Image b = a;
        b.pixels[b.index(3, 1)][channel] = 0.5f;
        for (const ImageErrors& errors : {image_errors(a, b), image_errors(b, a)}) {
            EXPECT_DOUBLE_EQ(errors.root_mean_square, std::sqrt(0.25 / 40));
            EXPECT_DOUBLE_EQ(errors.mean_absolute, 0.5 / 40);
            EXPECT_EQ(errors.largest, 0.5);
            EXPECT_EQ(errors.largest_at, glm::ivec2(3, 1));
            EXPECT_DOUBLE_EQ(errors.beyond_one_level, 0.1);
        }
    }
}

TEST(ImageErrors, CountAPixelBeyondOneLevelOfAByte)
{
    EXPECT_EQ(image_errors(grey({2, 2}, 0), grey({2, 2}, 0.99f / 255)).beyond_one_level, 0);
    EXPECT_EQ(image_errors(grey({2, 2}, 0), grey({2, 2}, 1.01f / 255)).beyond_one_level, 1);
}

TEST(ImageErrors, LeaveOutWhatIsMasked)
{
    const Image a = grey({2, 1}, 0);
    Image b = a;
    b.pixels[0] = glm::vec4(1);
    b.pixels[1] = glm::vec4(0.25f);
    const ImageErrors errors = image_errors(a, b, std::vector<std::uint8_t>{1, 0});
    EXPECT_EQ(errors.pixels, 1U);
    EXPECT_EQ(errors.largest, 0.25);
    EXPECT_EQ(errors.root_mean_square, 0.25);
    EXPECT_EQ(errors.mean_absolute, 0.25);
    EXPECT_EQ(errors.beyond_one_level, 1);
    EXPECT_EQ(errors.largest_at, glm::ivec2(1, 0));
}

TEST(ImageErrors, DoNotHideWhatIsNotANumber)
{
    Image a = grey({2, 2}, 0), b = a;
    a.pixels[2].g = b.pixels[2].g = std::numeric_limits<float>::quiet_NaN();
    const ImageErrors errors = image_errors(a, b);
    EXPECT_TRUE(std::isinf(errors.largest));
    EXPECT_TRUE(std::isinf(errors.root_mean_square));
    EXPECT_EQ(errors.beyond_one_level, 0.25);
    EXPECT_EQ(errors.largest_at, glm::ivec2(0, 1));
}

TEST(ImageErrors, RefuseImagesThatCannotBeCompared)
{
    EXPECT_THROW(image_errors(grey({2, 3}, 0), grey({3, 2}, 0)), InputError);
    EXPECT_THROW(image_errors(grey({2, 1}, 0), grey({2, 1}, 0), std::vector<std::uint8_t>{1}), InputError);
    EXPECT_THROW(image_errors(grey({2, 1}, 0), grey({2, 1}, 0), std::vector<std::uint8_t>{1, 1}), InputError);
    EXPECT_THROW(image_errors({}, {}), InputError);
    EXPECT_THROW(difference_image(grey({2, 3}, 0), grey({3, 2}, 0), 1), InputError);
}

TEST(DifferenceImage, IsWhiteWhereImagesAreEqualAndDarkRedWhereTheyAreFarApart)
{
    const Image a = grey({3, 1}, 0);
    Image b = a;
    b.pixels[1].b = 0.125f;
    b.pixels[2].a = 0.5f;
    const Image difference = difference_image(a, b, 4);
    EXPECT_EQ(difference.pixels[0], glm::vec4(1));
    EXPECT_EQ(difference.pixels[1], glm::vec4(0.85f, 0.5f, 0.5f, 1));
    EXPECT_EQ(difference.pixels[2], glm::vec4(0.7f, 0, 0, 1));
}

} // namespace
} // namespace visorder::tests
