#pragma once

#include "scene/scalar_interval.h"
#include "visorder/transfer_function.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace visorder::detail {

struct TransferFunctionFileOptions {
    double unit_length = 1; ///< the distance over which the opacities of a ParaView file hold
    std::string map;        ///< the name of the colour map to take from a ParaView file that holds several
    /// The lowest and the highest scalar of a scene, over which a ParaView map is spread.
    std::optional<ScalarInterval> spread = std::nullopt;
    bool first_map = false; ///< whether the first of several colour maps is taken where no name is given
};

/// Reads a transfer function from a JSON file in one of two formats. Both may have comments and commas after the last
/// of several values, as ParaView allows them.
///
/// visorder's own, an object; colours are linear, and of two points at one scalar the second holds from there on:
///
///     {"points": [{"scalar": 0.0, "extinction": 0.5, "colour": [0.1, 0.2, 0.8]}, ...]}
///
/// ParaView's colour maps (those its Choose Preset dialog exports), an array of objects, of which are read
/// - "RGBPoints": [scalar, red, green, blue, ...], sRGB in [0, 1], made linear. Of more than two points at one scalar,
///   the first and the last count, and make a jump;
/// - "ColorSpace", in which colours are interpolated: RGB (also where there is none), HSV (the shorter way around if
///   "HSVWrap" is set), Lab, CIELAB, Diverging and Step (from one point to the next, the colour of the next).
///   Lab/CIEDE2000 is taken as Lab, from which it differs a little between points;
/// - "IndexedColors": [red, green, blue, ...], colours of categories, where there are no "RGBPoints" or "IndexedLookup"
///   is set. With "Annotations" of which all values are numbers, each colour holds half way to the neighbouring values;
///   else the range of scalars, [0, 1] if it is not spread, is cut into equal parts, one a colour;
/// - "Points", if there: [scalar, opacity, midpoint, sharpness, ...], which mean what they do in vtkPiecewiseFunction;
///   else opacity rises from 0 at the first colour to 1 at the last, as it does in ParaView until it is changed, and is
///   0.3 in all categories. Extinction is -log(1 - opacity) / unit length. Above 0.999, opacity is taken as 0.999:
///   extinction is finite;
/// - "Name", where there are several maps to choose from.
/// Opacity, and each channel of colour as sRGB and linear, is that of VTK's functions to 1e-3, by as many points as
/// that takes. Refused are logarithmic scales ("UseLogScale"). NanColor and the rest are of no use here.
///
/// A ParaView map is spread over `spread`, if given, as ParaView does when a preset is chosen: from the range of its
/// colours, whatever that is, unless it has one scalar alone or its categories have values. Over a range of one scalar
/// it is constant, what it is at its lowest, but of opacity 0.3 if it says none. All other scalars are taken as they
/// stand. Throws InputError, one line that names the file and the point (counted from 0): a file that cannot be read or
/// is no JSON, several maps with neither a name nor `first_map` given, and what TransferFunction does not take.
TransferFunction read_transfer_function(const std::filesystem::path& file,
                                        const TransferFunctionFileOptions& options = {});

/// The names of the colour maps in a ParaView file, in its order; empty for one that has none, and no names at all for
/// visorder's own format. Throws InputError for a file that cannot be read or is no JSON.
std::vector<std::string> colour_map_names(const std::filesystem::path& file);

} // namespace visorder::detail
