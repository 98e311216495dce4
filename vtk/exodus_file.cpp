#include "scene/error.h"
#include "vtk/message_capture.h"
#include "vtk/netcdf_length.h"
#include "vtk/vtk_file.h"

#include <fmt/format.h>
#include <vtkCompositeDataIterator.h>
#include <vtkExodusIIReader.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtk_netcdf.h>

namespace visorder {

namespace {

/// VTK's copy of the Exodus library prints to the terminal when it opens anything else.
void check_signature(const std::filesystem::path& path)
{
    int id = 0;
    if (const int error = nc_open(path.c_str(), NC_NOWRITE, &id); error != NC_NOERR)
        throw InputError(fmt::format("{}: cannot be read: {}", path.string(), nc_strerror(error)));
    const bool is_exodus = nc_inq_attid(id, NC_GLOBAL, "api_version", nullptr) == NC_NOERR;
    nc_close(id);
    if (!is_exodus)
        throw InputError(fmt::format("{}: cannot be read: a netCDF file, but not of Exodus II", path.string()));
}

} // namespace

VtkFile read_exodus_file(const std::filesystem::path& path)
{
    // The netCDF library takes what lies beyond the end of a file for zeros.
    if (const auto needed = declared_netcdf_length(path); needed && std::filesystem::file_size(path) < *needed)
        throw InputError(fmt::format("{}: cannot be read: it is cut short, {} of {} bytes are there", path.string(),
                                     std::filesystem::file_size(path), *needed));
    check_signature(path);

    const vtkNew<vtkExodusIIReader> reader;
    reader->SetFileName(path.c_str());
    reader->SetSqueezePoints(false); // every block indexes all points of the file, so that blocks share them
    reader->SetApplyDisplacements(false);
    reader->SetGenerateObjectIdCellArray(false); // numbers of blocks would pass for data
    // What the file holds first: the reader crashes if it goes on to read data after an error in that.
    std::vector<std::string> notes = run_reader(path, [&] { reader->UpdateInformation(); });
    for (const int kind : {vtkExodusIIReader::NODAL, vtkExodusIIReader::ELEM_BLOCK})
        reader->SetAllArrayStatus(kind, 1);
    for (int block = 0; block < reader->GetNumberOfElementBlockArrays(); ++block)
        reader->SetObjectStatus(vtkExodusIIReader::ELEM_BLOCK, block, 1);
    for (std::string& note : run_reader(path, [&] { reader->Update(); }))
        notes.push_back(std::move(note));

    VtkFile file{path, {}, "", std::move(notes)};
    const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(reader->GetOutput()->NewIterator());
    for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
        if (auto* part = vtkDataSet::SafeDownCast(block->GetCurrentDataObject()); part && part->GetNumberOfCells() > 0)
            file.parts.emplace_back(part);
    if (file.parts.empty())
        throw InputError(fmt::format("{}: there are no cells in it", path.string()));
    return file;
}

} // namespace visorder
