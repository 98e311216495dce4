#pragma once

#include "vtk/vtk_file.h"

namespace visorder::detail {

/// What the opening tag of a VTK XML file says it holds, as "UnstructuredGrid"; empty for any other file.
std::string declared_xml_type(const std::filesystem::path& path);

/// Whether files of that declared type are read by `read_xml_data_set`.
bool is_xml_data_set(const std::string& type);

/// Reads a file of one data set; a grid of cells in pieces gives a part for each piece. Throws InputError, naming the
/// file.
VtkFile read_xml_data_set(const std::filesystem::path& path, const std::string& type, const std::string& time);

/// Reads a file that names others: pieces, blocks or time steps. Throws InputError, naming the file at fault.
VtkFile read_xml_collection(const std::filesystem::path& path, const std::string& type, const std::string& time);

} // namespace visorder::detail
