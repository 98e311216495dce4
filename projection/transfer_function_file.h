#pragma once

#include "projection/transfer_function.h"
#include "scene/scalar_interval.h"

#include <filesystem>
#include <optional>
#include <string>

namespace visorder {

struct TransferFunctionFileOptions {
    double unit_length = 1; ///< the distance over which the opacities of a ParaView file hold
    std::string map;        ///< the name of the colour map to take from a ParaView file that holds several
    /// The lowest and the highest scalar of a scene, over which a ParaView map from 0 to 1 is spread.
    std::optional<ScalarInterval> spread = std::nullopt;
};

/// Reads a transfer function from a JSON file in one of two formats.
///
/// visorder's own, an object; colours are linear, and of two points at one scalar the second holds from there on:
///
///     {"points": [{"scalar": 0.0, "extinction": 0.5, "colour": [0.1, 0.2, 0.8]}, ...]}
///
/// ParaView's colour maps (those its Choose Preset dialog exports), an array of objects, of which are read
/// - "RGBPoints": [scalar, red, green, blue, ...], sRGB in [0, 1], made linear;
/// - "Points", if there: [scalar, opacity, midpoint, sharpness, ...]; else opacity rises from 0 at the first colour to
/// 1
///   at the last, as it does in ParaView until it is changed. Opacity is linear between two points, and extinction,
///   -log(1 - opacity) / unit length, follows it in 16 parts. Above 0.999 it is taken as 0.999: extinction is finite;
/// - "ColorSpace": RGB. Lab, CIELAB, Lab/CIEDE2000 and Diverging are taken as RGB too: the colours at the points are
///   right, those between them differ a little, and hardly where points are many. HSV and Step are refused;
/// - "Name", where there are several maps to choose from.
/// Refused are midpoints other than 0.5, sharpness other than 0, logarithmic scales ("UseLogScale") and maps of colours
/// for categories ("IndexedColors" without "RGBPoints"). NanColor and the rest are of no use here.
///
/// Scalars are taken as they stand, but for a ParaView map of which the colours run from exactly 0 to exactly 1, as
/// those of most presets do: where there is a range to spread it over, colours and opacities are, as in ParaView when a
/// preset is chosen. Over a range of one scalar it is constant, what it is at 0. Throws InputError, one line that names
/// the file and the point (counted from 0): a file that cannot be read or is no JSON, and what TransferFunction does
/// not take.
TransferFunction read_transfer_function(const std::filesystem::path& file,
                                        const TransferFunctionFileOptions& options = {});

} // namespace visorder
