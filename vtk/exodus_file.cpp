#include "files/time_step.h"
#include "visorder/error.h"
#include "vtk/message_capture.h"
#include "vtk/netcdf_length.h"
#include "vtk/vtk_file.h"

#include <fmt/format.h>
#include <vtkCompositeDataIterator.h>
#include <vtkExodusIIReader.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtk_netcdf.h>

namespace visorder::detail {

namespace {

/// A file that is open by the netCDF library.
class NetcdfInput {
public:
    explicit NetcdfInput(const std::filesystem::path& path)
    {
        if (const int error = nc_open(path.c_str(), NC_NOWRITE, &id_); error != NC_NOERR)
            throw InputError(fmt::format("{}: cannot be read: {}", path.string(), nc_strerror(error)));
    }
    ~NetcdfInput() { nc_close(id_); }
    NetcdfInput(const NetcdfInput&) = delete;
    NetcdfInput& operator=(const NetcdfInput&) = delete;

    bool has_attribute(const char* name) const { return nc_inq_attid(id_, NC_GLOBAL, name, nullptr) == NC_NOERR; }

    /// The times of an Exodus file's steps.
    std::vector<double> times() const
    {
        int variable = 0, dimensions = 0, dimension = 0;
        std::size_t steps = 0;
        if (nc_inq_varid(id_, "time_whole", &variable) != NC_NOERR ||
            nc_inq_varndims(id_, variable, &dimensions) != NC_NOERR || dimensions != 1 ||
            nc_inq_vardimid(id_, variable, &dimension) != NC_NOERR || nc_inq_dimlen(id_, dimension, &steps) != NC_NOERR)
            return {};
        std::vector<double> times(steps);
        if (steps > 0 && nc_get_var_double(id_, variable, times.data()) != NC_NOERR)
            return {};
        return times;
    }

private:
    int id_ = 0;
};

} // namespace

VtkFile read_exodus_file(const std::filesystem::path& path, const std::string& time)
{
    // The netCDF library takes what lies beyond the end of a file for zeros.
    if (const auto needed = declared_netcdf_length(path); needed && std::filesystem::file_size(path) < *needed)
        throw InputError(fmt::format("{}: cannot be read: it is cut short, {} of {} bytes are there", path.string(),
                                     std::filesystem::file_size(path), *needed));
    std::vector<double> times;
    {
        const NetcdfInput input(path);
        // VTK's copy of the Exodus library prints to the terminal when it opens anything else.
        if (!input.has_attribute("api_version"))
            throw InputError(fmt::format("{}: cannot be read: a netCDF file, but not of Exodus II", path.string()));
        times = input.times();
    }

    const vtkNew<vtkExodusIIReader> reader;
    reader->SetFileName(path.c_str());
    reader->SetSqueezePoints(false); // every block indexes all points of the file, so that blocks share them
    reader->SetApplyDisplacements(false);
    reader->SetGenerateObjectIdCellArray(false); // numbers of blocks would pass for data
    // What the file holds first: the reader crashes if it goes on to read data after an error in that.
    std::vector<std::string> notes = run_reader(path, [&] { reader->UpdateInformation(); });
    reader->SetTimeStep(static_cast<int>(choose_time_step(path, times, time, notes)));
    for (const int kind : {vtkExodusIIReader::NODAL, vtkExodusIIReader::ELEM_BLOCK})
        reader->SetAllArrayStatus(kind, 1);
    for (int block = 0; block < reader->GetNumberOfElementBlockArrays(); ++block)
        reader->SetObjectStatus(vtkExodusIIReader::ELEM_BLOCK, block, 1);
    for (std::string& note : run_reader(path, [&] { reader->Update(); }))
        notes.push_back(std::move(note));

    VtkFile file{path, {}, true, std::move(notes)};
    const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(reader->GetOutput()->NewIterator());
    for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
        if (auto* part = vtkDataSet::SafeDownCast(block->GetCurrentDataObject());
            part && part->GetNumberOfCells() > 0) {
            const char* name = block->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME());
            file.parts.push_back({part, name && *name ? name : fmt::format("block {}", file.parts.size())});
        }
    if (file.parts.empty())
        throw InputError(fmt::format("{}: there are no cells in it", path.string()));
    return file;
}

} // namespace visorder::detail
