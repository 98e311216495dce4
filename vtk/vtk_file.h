#pragma once

#include <filesystem>
#include <string>
#include <vector>
#include <vtkDataSet.h>
#include <vtkSmartPointer.h>

namespace visorder::detail {

/// What a VTK reader made of a file.
struct VtkFile {
    struct Part {
        vtkSmartPointer<vtkDataSet> data;
        std::string block; ///< name of the block that begins with this part; empty: it goes on with the last one's
    };
    std::filesystem::path path;
    std::vector<Part> parts;    ///< at least one
    bool shared_points = false; ///< a point has the same number in all parts
    std::vector<std::string> notes;
};

// `time` as in ReadOptions. Each throws InputError, naming the file, where VTK reports an error or the file is cut
// short.
VtkFile read_xml_file(const std::filesystem::path& path, const std::string& time);
VtkFile read_legacy_file(const std::filesystem::path& path, const std::string& time);
VtkFile read_exodus_file(const std::filesystem::path& path, const std::string& time);

} // namespace visorder::detail
