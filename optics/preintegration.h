#pragma once

#include "optics/optical_pieces.h"

#include <cstddef>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace visorder::detail {

/// Light (premultiplied) and opacity of a way along which the scalar runs linearly from one value to another.
glm::dvec4 light_along(const OpticalPieces& pieces, double front, double back, double length);

/// The mean extinction along such a way.
double mean_extinction(const OpticalPieces& pieces, double front, double back);

/// The table of Roettger, Kraus and Ertl 2000, Hardware-accelerated volume and isosurface rendering based on cell
/// projection, section 4: light and opacity along `length`, for front and back scalars k / (size - 1). Front runs
/// fastest. On all threads.
std::vector<glm::vec4> preintegrated_2d(const OpticalPieces& pieces, std::size_t size, double length);

/// Their table of section 3, with densities in place of what has been integrated: light over length, which is nearly
/// linear between two lengths, and mean extinction, which does not depend on the length at all. `lengths` may be
/// infinite. Front runs fastest, length slowest. On all threads.
std::vector<glm::vec4> preintegrated_3d(const OpticalPieces& pieces, std::size_t size, std::span<const double> lengths);

/// The lengths of a table's third coordinate y = k / (count - 1): y longest, or, as y = 1 - 2^-l (Roettger, Guthe,
/// Schieber and Ertl 2004, Convexification of unstructured grids, section 8), finer for shorter ones.
struct LengthAxis {
    std::vector<double> lengths;
    double scale; ///< l in y = 1 - 2^-l, or y itself, is this times the length
};
LengthAxis length_axis(std::size_t count, double longest, bool exponential);

} // namespace visorder::detail
