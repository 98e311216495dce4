#pragma once

#include <filesystem>
#include <string_view>

namespace visorder::detail {

/// Goes through a file of one of VTK's XML formats before VTK does, which believes what it says: that the file is long
/// enough for its points, cells and arrays, compressed data taken into account, and that the faces of polyhedra are
/// there. Throws InputError, naming the file and the array, where not; nothing is said of what VTK itself refuses.
void check_xml_file(const std::filesystem::path& path);

/// The same of a file's content; the message does not name the file.
void check_xml_content(std::string_view content);

} // namespace visorder::detail
