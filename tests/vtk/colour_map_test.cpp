// ParaView's colour maps against the functions of VTK that ParaView interpolates them by.

#include "files/transfer_function_file.h"
#include "optics/srgb.h"
#include "tests/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>
#include <vtkColorTransferFunction.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>

namespace visorder::tests {

using namespace detail;
namespace {

constexpr double tolerance = 1e-3;
constexpr int samples = 4001;
constexpr ScalarInterval scene{-3, 7.5};

using Numbers = std::vector<double>;

struct Space {
    std::string entries; // of the file
    int vtk;
    bool wraps = false;
};
const std::vector<Space> spaces{
    {R"("ColorSpace": "RGB")", VTK_CTF_RGB},
    {R"("ColorSpace": "HSV")", VTK_CTF_HSV},
    {R"("ColorSpace": "HSV", "HSVWrap": 0)", VTK_CTF_HSV},
    {R"("ColorSpace": "HSV", "HSVWrap": 1)", VTK_CTF_HSV, true},
    {R"("ColorSpace": "Lab")", VTK_CTF_LAB},
    {R"("ColorSpace": "CIELAB")", VTK_CTF_LAB},
    {R"("ColorSpace": "Diverging")", VTK_CTF_DIVERGING},
    {R"("ColorSpace": "Step")", VTK_CTF_STEP},
};

// Hues around the circle and across it, greys, black, white, and jumps.
const std::vector<Numbers> colour_points{
    {0, 0.231373, 0.298039, 0.752941, 1, 0.705882, 0.0156863, 0.14902},
    {-1, 0.23, 0.299, 0.754, 0, 0.865, 0.865, 0.865, 1, 0.706, 0.016, 0.15},
    {0, 1, 0, 0, 0.1, 1, 0, 1, 0.4, 0, 0, 1, 0.5, 0, 1, 0, 1, 1, 0, 0.1},
    {0, 0, 0, 0, 100, 1, 1, 1, 200, 0.2, 0.9, 0.3, 255, 0, 0, 0},
    {0, 0, 0, 1, 0.5, 0, 1, 0, 0.5, 1, 1, 1, 0.5, 1, 1, 0, 1, 1, 0, 0},
    {-2, 0.9, 0.1, 0.1, 1, 0.9, 0.1, 0.3, 1.5, 0.1, 0.6, 0.1, 2, 0.11, 0.6, 0.9, 9, 0.5, 0.5, 0.5},
};

// As maps with a point for each of 256 colours, but for one jump.
Numbers many_points()
{
    Numbers points;
    for (int i = 0; i < 256; ++i) {
        const double t = i / 255.0 + (i > 200 ? 0.1 : 0);
        points.insert(points.end(), {i == 201 ? 200.0 : i, 0.3 + 0.3 * std::sin(7 * t), 0.8 * t, 0.5 - 0.4 * t * t});
    }
    return points;
}

const std::vector<Numbers> opacity_points{
    {0, 0, 0.5, 0, 1, 1, 0.5, 0},
    {0, 0.1, 0.2, 0, 0.5, 0.9, 0.8, 0, 1, 0, 0.5, 0},
    {0, 0.9, 0.3, 0.4, 0.6, 0.1, 0.7, 0.9, 1, 0.8, 0.5, 0},
    {0, 0.2, 0.5, 1, 0.4, 0.7, 0.1, 0.995, 1, 0.1, 0.5, 0},
    {0, 0.2, 0, 0.02, 0.4, 0.7, 1, 0.5, 1, 0.1, 0.5, 0},
    {0.2, 0.5, 0.5, 0, 0.5, 0.1, 0.5, 0, 0.5, 0.9, 0.5, 0.3, 0.8, 0.3, 0.5, 0},
};

TransferFunction read(const std::string& map)
{
    const TemporaryFolder folder;
    return read_transfer_function(folder.write("map.json", "[{" + map + "}]"), {2, "", scene});
}

double spread(double scalar, double first, double last)
{
    return std::lerp(scene.lowest, scene.highest, (scalar - first) / (last - first));
}

// Dense, and nowhere so near to one of the scalars that rounding decides on which side of a jump it is.
template <class Check>
void at_samples(const std::vector<double>& jumps, const Check& check)
{
    for (int i = 0; i < samples; ++i) {
        const double t = (i + 1 / std::numbers::phi) / samples;
        const double scalar = std::lerp(scene.lowest - 1, scene.highest + 1, t);
        if (std::none_of(jumps.begin(), jumps.end(), [&](double jump) { return std::abs(scalar - jump) < 1e-9; }))
            check(scalar);
    }
}

TEST(ParaViewColourMap, PassesFromColourToColourAsVtkDoes)
{
    std::vector<Numbers> maps = colour_points;
    maps.push_back(many_points());
    for (const Space& space : spaces)
        for (const Numbers& points : maps) {
            SCOPED_TRACE(fmt::format("{}, RGBPoints {}", space.entries, points));
            const TransferFunction function =
                read(fmt::format("{}, \"RGBPoints\": [{}]", space.entries, fmt::join(points, ", ")));
            // Between any two of the points that there are in the end, the renderer draws cells once more.
            if (space.vtk == VTK_CTF_RGB && points == maps.back()) {
                EXPECT_LT(function.points().size(), 180U);
            }
            vtkNew<vtkColorTransferFunction> expected;
            expected->SetAllowDuplicateScalars(1);
            expected->SetColorSpace(space.vtk);
            expected->SetHSVWrap(space.wraps ? 1 : 0);
            std::vector<double> scalars;
            for (std::size_t i = 0; i < points.size(); i += 4) {
                scalars.push_back(spread(points[i], points[0], points[points.size() - 4]));
                expected->AddRGBPoint(scalars.back(), points[i + 1], points[i + 2], points[i + 3]);
            }
            double most = 0;
            at_samples(scalars, [&](double scalar) {
                const glm::dvec3 colour = function.at(scalar).colour;
                double stored[3];
                expected->GetColor(scalar, stored);
                for (int k = 0; k < 3; ++k)
                    most = std::max({most, std::abs(srgb_of_linear(colour[k]) - stored[k]),
                                     std::abs(colour[k] - linear_of_srgb(stored[k]))});
            });
            EXPECT_LT(most, tolerance);
        }
}

TEST(ParaViewColourMap, HasTheOpacitiesOfVtk)
{
    for (const Numbers& points : opacity_points) {
        SCOPED_TRACE(fmt::format("Points {}", points));
        const TransferFunction function =
            read(fmt::format("\"RGBPoints\": [0, 1, 0, 0, 1, 0, 0, 1], \"Points\": [{}]", fmt::join(points, ", ")));
        vtkNew<vtkPiecewiseFunction> expected;
        expected->SetAllowDuplicateScalars(1);
        std::vector<double> jumps;
        for (std::size_t i = 0; i < points.size(); i += 4) {
            expected->AddPoint(spread(points[i], 0, 1), points[i + 1], points[i + 2], points[i + 3]);
            jumps.push_back(spread(points[i], 0, 1));
            if (i + 4 < points.size())
                jumps.push_back(spread(std::lerp(points[i], points[i + 4], points[i + 2]), 0, 1));
        }
        double most = 0;
        at_samples(jumps, [&](double scalar) {
            const double opacity = -std::expm1(-function.at(scalar).extinction * 2);
            most = std::max(most, std::abs(opacity - std::min(0.999, expected->GetValue(scalar))));
        });
        EXPECT_LT(most, tolerance);
    }
}

} // namespace
} // namespace visorder::tests
