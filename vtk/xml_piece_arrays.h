#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace visorder::detail {

/// The names of the arrays that a piece of a VTK XML file lists.
struct XmlPieceArrays {
    std::vector<std::string> of_points;
    std::vector<std::string> of_cells;
};

/// Those of all pieces of a file that VTK has read, in the file's order.
std::vector<XmlPieceArrays> xml_piece_arrays(const std::filesystem::path& path);

} // namespace visorder::detail
