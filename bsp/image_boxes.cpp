#include "bsp/image_boxes.h"

#include <algorithm>

namespace visorder::detail {

void ImageBoxes::reset(std::size_t faces, int charts)
{
    faces_ = faces;
    charts_ = charts;
    boxes_.resize(faces * static_cast<std::size_t>(charts));
}

void ImageBoxes::set(std::size_t face, int chart, const Box& box, Ranks ranks)
{
    const auto rounded = [](double x) {
        constexpr double most = std::numeric_limits<float>::max();
        return static_cast<float>(std::clamp(x, -most, most));
    };
    ImageBox& image = boxes_[place(face, chart)];
    image.min = {rounded(box.min.x), rounded(box.min.y)};
    image.max = {rounded(box.max.x), rounded(box.max.y)};
    image.nearest = rounded(box.min.z);
    image.farthest = rounded(box.max.z);
    image.ranks = ranks;
}

} // namespace visorder::detail
