#pragma once

#include <cmath>
#include <glm/vec3.hpp>

namespace visorder::detail {

/// The transfer functions of sRGB (IEC 61966-2-1) between linear intensities and the values that are stored and shown,
/// both in [0, 1]. Colours blend in linear intensities; colour maps are published and pictures written in stored ones.
inline double linear_of_srgb(double stored)
{
    return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
}

inline glm::dvec3 linear_of_srgb(const glm::dvec3& stored)
{
    return {linear_of_srgb(stored.x), linear_of_srgb(stored.y), linear_of_srgb(stored.z)};
}

inline double srgb_of_linear(double intensity)
{
    return intensity <= 0.0031308 ? intensity * 12.92 : 1.055 * std::pow(intensity, 1 / 2.4) - 0.055;
}

} // namespace visorder::detail
