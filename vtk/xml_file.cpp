#include "scene/error.h"
#include "vtk/message_capture.h"
#include "vtk/vtk_file.h"
#include "vtk/xml_check.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <vtkNew.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace visorder {

namespace {

/// VTK stops parsing where the appended data starts, and does not miss what is cut off after it.
bool has_closing_tag(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    const auto length = static_cast<std::streamoff>(std::filesystem::file_size(path));
    std::string tail(static_cast<std::size_t>(std::min<std::streamoff>(length, 1024)), '\0');
    file.seekg(length - static_cast<std::streamoff>(tail.size()));
    file.read(tail.data(), static_cast<std::streamsize>(tail.size()));
    return tail.find("</VTKFile>") != std::string::npos;
}

} // namespace

VtkFile read_xml_file(const std::filesystem::path& path)
{
    check_xml_file(path);
    const vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(path.c_str());
    std::vector<std::string> notes = run_reader(path, [&] { reader->Update(); });
    if (!has_closing_tag(path))
        throw InputError(fmt::format("{}: cannot be read: it is cut short, there is no </VTKFile>", path.string()));
    return {path, {reader->GetOutput()}, "", std::move(notes)};
}

} // namespace visorder
