#pragma once

#include <filesystem>
#include <string_view>

namespace visorder::detail {

/// Goes through a legacy VTK file before VTK does, which believes what it says: that counts are those of what follows
/// them, and lists of cells and their types fit each other. A file of the wrong byte order has counts that do not fit.
/// Throws InputError, naming the file and the section, where one does not, and where there is something that VTK does
/// not know. Values are not looked at.
void check_legacy_file(const std::filesystem::path& path);

/// The same of a file's content; the message does not name the file.
void check_legacy_content(std::string_view content);

} // namespace visorder::detail
