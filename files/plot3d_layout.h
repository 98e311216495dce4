#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace visorder::detail {

/// Plot3D's files of grids and of solutions on them differ in how many numbers they have before the points of a grid,
/// and for each point.
enum class Plot3dContent { grid, solution };

/// One of the grids of a file.
struct Plot3dZone {
    glm::ivec3 size{1};        ///< points along each axis
    int reals_per_point = 0;   ///< all of the points' first numbers come first, then all of their second ones
    std::vector<double> reals; ///< empty if there are more in the file than there is use for
    std::vector<bool> blank;   ///< for each point whether the grid has none there, or empty

    std::size_t points() const
    {
        return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
    }
    double real(std::size_t point, int i) const { return reals[static_cast<std::size_t>(i) * points() + point]; }
};

struct Plot3dZones {
    std::vector<Plot3dZone> zones;
    int axes = 3; ///< 2: points have no z, and momentum has two components
};

/// The grids of a file, in whichever layout its length fits: of either byte order, with or without the number of grids
/// and Fortran's counts of bytes around records, in single or double precision, with or without blanking, of points in
/// space or in a plane; or in text. A solution may be longer than it need be: some are padded to blocks of 512 bytes.
/// Nothing if no layout fits. `axes`: only such grids; 0: of both kinds.
std::optional<Plot3dZones> find_plot3d_zones(const std::filesystem::path& path, std::string_view content,
                                             Plot3dContent kind, int axes);

} // namespace visorder::detail
