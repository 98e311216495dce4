#pragma once

#include <filesystem>
#include <string>
#include <vector>
#include <vtkDataSet.h>
#include <vtkSmartPointer.h>

namespace visorder {

/// What a VTK reader made of a file.
struct VtkFile {
    std::filesystem::path path;
    std::vector<vtkSmartPointer<vtkDataSet>> parts; ///< at least one; a point has the same number in all of them
    std::string default_scalar;                     ///< empty: to be chosen by kind
    std::vector<std::string> notes;
};

// Each throws InputError, naming the file, where VTK reports an error or the file is cut short.
VtkFile read_xml_file(const std::filesystem::path& path);
VtkFile read_legacy_file(const std::filesystem::path& path);
VtkFile read_exodus_file(const std::filesystem::path& path);
VtkFile read_plot3d_file(const std::filesystem::path& path);

} // namespace visorder
