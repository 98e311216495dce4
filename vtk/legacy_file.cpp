#include "files/time_step.h"
#include "visorder/error.h"
#include "vtk/legacy_check.h"
#include "vtk/message_capture.h"
#include "vtk/vtk_file.h"

#include <fmt/format.h>
#include <fstream>
#include <vtkDataSetReader.h>
#include <vtkNew.h>

namespace visorder::detail {

namespace {

bool has_signature(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::string signature(std::string_view("# vtk DataFile").size(), '\0');
    file.read(signature.data(), static_cast<std::streamsize>(signature.size()));
    return signature == "# vtk DataFile";
}

} // namespace

VtkFile read_legacy_file(const std::filesystem::path& path, const std::string& time)
{
    if (!has_signature(path))
        throw InputError(fmt::format("{}: cannot be read: not a legacy VTK file", path.string()));

    check_legacy_file(path);
    const vtkNew<vtkDataSetReader> reader;
    reader->SetFileName(path.c_str());
    reader->ReadAllScalarsOn();
    reader->ReadAllVectorsOn();
    reader->ReadAllFieldsOn();
    std::vector<std::string> notes = run_reader(path, [&] { reader->Update(); });
    if (!reader->GetOutput())
        throw InputError(fmt::format("{}: cannot be read: it holds no VTK data set", path.string()));
    choose_time_step(path, {}, time, notes);
    return {path, {{reader->GetOutput(), ""}}, false, std::move(notes)};
}

} // namespace visorder::detail
