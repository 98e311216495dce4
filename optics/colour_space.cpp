#include "optics/colour_space.h"

#include "optics/srgb.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace visorder::detail {

namespace {

using std::numbers::pi;

// Hue from 0 to 1.
glm::dvec3 hsv_of(const glm::dvec3& rgb)
{
    const double most = std::max({rgb.r, rgb.g, rgb.b});
    const double least = std::min({rgb.r, rgb.g, rgb.b});
    const double range = most - least;
    if (range == 0)
        return {0, 0, most};
    const double sixth = most == rgb.r   ? (rgb.g - rgb.b) / range
                         : most == rgb.g ? 2 + (rgb.b - rgb.r) / range
                                         : 4 + (rgb.r - rgb.g) / range;
    return {sixth < 0 ? sixth / 6 + 1 : sixth / 6, range / most, most};
}

glm::dvec3 rgb_of_hsv(const glm::dvec3& hsv)
{
    // A channel is full within a sixth of the circle of its own hue, and gone from a third on.
    const auto channel = [&](double own_hue) {
        const double away = std::abs(hsv.x - own_hue);
        const double part = std::clamp(2 - 6 * std::min(away, 1 - away), 0.0, 1.0);
        return hsv.z * (1 - hsv.y * (1 - part));
    };
    return {channel(0), channel(1.0 / 3), channel(2.0 / 3)};
}

glm::dvec3 between_hues(glm::dvec3 from, glm::dvec3 to, double t, bool wraps)
{
    if (wraps && std::abs(from.x - to.x) > 0.5)
        (from.x > to.x ? from.x : to.x) -= 1;
    glm::dvec3 hsv = glm::mix(from, to, t);
    if (hsv.x < 0)
        hsv.x += 1;
    return rgb_of_hsv(hsv);
}

// sRGB's primaries and its white, D65, as VTK rounds them; columns are red, green and blue.
constexpr glm::dmat3 xyz_of_linear(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722, 0.9505);
constexpr glm::dmat3 linear_of_xyz(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570);
constexpr glm::dvec3 white(0.9505, 1, 1.089);

// The lightness curve of CIE 1976: a cube root, linear near black.
constexpr double linear_below = 0.008856;
constexpr double slope = 7.787;
constexpr double offset = 16.0 / 116;

double lightness(double part)
{
    return part > linear_below ? std::cbrt(part) : slope * part + offset;
}

double inverse_lightness(double value)
{
    const double cube = value * value * value;
    return cube > linear_below ? cube : (value - offset) / slope;
}

glm::dvec3 lab_of(const glm::dvec3& rgb)
{
    const glm::dvec3 part = xyz_of_linear * linear_of_srgb(rgb) / white;
    const glm::dvec3 f(lightness(part.x), lightness(part.y), lightness(part.z));
    return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)};
}

// What no screen can show is darkened until the largest channel fits, and negative channels become zero.
glm::dvec3 rgb_of_lab(const glm::dvec3& lab)
{
    const double y = (lab.x + 16) / 116;
    const glm::dvec3 xyz(inverse_lightness(lab.y / 500 + y), inverse_lightness(y), inverse_lightness(y - lab.z / 200));
    const glm::dvec3 linear = linear_of_xyz * (xyz * white);
    const glm::dvec3 rgb(srgb_of_linear(linear.r), srgb_of_linear(linear.g), srgb_of_linear(linear.b));
    return glm::max(rgb / std::max({1.0, rgb.r, rgb.g, rgb.b}), 0.0);
}

// L*a*b* in polar coordinates: magnitude, saturation and hue, the last two of them angles.
struct Msh {
    double magnitude, saturation, hue;
};

constexpr double least_saturation = 0.05; // below, there is no hue to speak of

Msh msh_of(const glm::dvec3& rgb)
{
    const glm::dvec3 lab = lab_of(rgb);
    const double magnitude = glm::length(lab);
    const double saturation = magnitude > 0.001 ? std::acos(lab.x / magnitude) : 0;
    return {magnitude, saturation, saturation > 0.001 ? std::atan2(lab.z, lab.y) : 0};
}

glm::dvec3 rgb_of_msh(const Msh& msh)
{
    const double across = msh.magnitude * std::sin(msh.saturation);
    return rgb_of_lab(
        {msh.magnitude * std::cos(msh.saturation), across * std::cos(msh.hue), across * std::sin(msh.hue)});
}

// The hue that a grey of some magnitude begins with, so that the way to a saturated colour looks even.
double hue_beside(const Msh& saturated, double magnitude_of_grey)
{
    if (saturated.magnitude >= magnitude_of_grey - 0.1)
        return saturated.hue;
    const double spin = saturated.saturation *
                        std::sqrt(magnitude_of_grey * magnitude_of_grey - saturated.magnitude * saturated.magnitude) /
                        (saturated.magnitude * std::sin(saturated.saturation));
    return saturated.hue > -0.3 * pi ? saturated.hue + spin : saturated.hue - spin;
}

glm::dvec3 between_diverging(Msh from, Msh to, double t)
{
    const double turn = std::abs(from.hue - to.hue);
    if (from.saturation > least_saturation && to.saturation > least_saturation &&
        std::min(turn, 2 * pi - turn) > 0.33 * pi) {
        const Msh middle{std::max({from.magnitude, to.magnitude, 88.0}), 0, 0};
        if (t < 0.5)
            to = middle;
        else
            from = middle;
        t = t < 0.5 ? 2 * t : 2 * t - 1;
    }
    if (from.saturation < least_saturation && to.saturation > least_saturation)
        from.hue = hue_beside(to, from.magnitude);
    else if (to.saturation < least_saturation && from.saturation > least_saturation)
        to.hue = hue_beside(from, to.magnitude);
    const auto mixed = [&](double a, double b) { return (1 - t) * a + t * b; };
    return rgb_of_msh(
        {mixed(from.magnitude, to.magnitude), mixed(from.saturation, to.saturation), mixed(from.hue, to.hue)});
}

} // namespace

glm::dvec3 between(ColourSpace space, const glm::dvec3& from, const glm::dvec3& to, double t)
{
    switch (space) {
    case ColourSpace::rgb:
        return glm::mix(from, to, t);
    case ColourSpace::hsv:
    case ColourSpace::hsv_wrapped:
        return between_hues(hsv_of(from), hsv_of(to), t, space == ColourSpace::hsv_wrapped);
    case ColourSpace::lab:
        return rgb_of_lab(glm::mix(lab_of(from), lab_of(to), t));
    case ColourSpace::diverging:
        return between_diverging(msh_of(from), msh_of(to), t);
    case ColourSpace::step:
        return to;
    }
    return to;
}

} // namespace visorder::detail
