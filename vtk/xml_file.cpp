#include "vtk/xml_file.h"

#include "files/time_step.h"
#include "visorder/error.h"
#include "vtk/message_capture.h"
#include "vtk/xml_check.h"
#include "vtk/xml_piece_arrays.h"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>
#include <vtkCellData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLPImageDataReader.h>
#include <vtkXMLPRectilinearGridReader.h>
#include <vtkXMLPStructuredGridReader.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLRectilinearGridReader.h>
#include <vtkXMLStructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

namespace visorder::detail {

namespace {

/// VTK stops parsing where the appended data starts, and does not miss what is cut off after it. Blanks may follow.
bool has_closing_tag(const std::filesystem::path& path)
{
    constexpr std::string_view blanks(" \t\r\n\0", 5);
    constexpr std::string_view tag = "</VTKFile>";
    constexpr std::streamoff most = 1 << 16;
    std::ifstream file(path, std::ios::binary);
    std::string tail;
    for (auto end = static_cast<std::streamoff>(std::filesystem::file_size(path)); end > 0;) {
        const std::streamoff begin = std::max<std::streamoff>(end - most, 0);
        std::string before(static_cast<std::size_t>(end - begin), '\0');
        file.seekg(begin);
        file.read(before.data(), static_cast<std::streamsize>(before.size()));
        tail.insert(0, before);
        tail.resize(tail.find_last_not_of(blanks) + 1);
        if (tail.size() >= 1024 || begin == 0)
            return tail.find(tag, tail.size() - std::min<std::size_t>(tail.size(), 1024)) != std::string::npos;
        end = begin;
    }
    return false;
}

vtkSmartPointer<vtkXMLReader> reader_of(const std::string& type)
{
    if (type == "UnstructuredGrid")
        return vtkSmartPointer<vtkXMLUnstructuredGridReader>::New();
    if (type == "PolyData")
        return vtkSmartPointer<vtkXMLPolyDataReader>::New();
    if (type == "StructuredGrid")
        return vtkSmartPointer<vtkXMLStructuredGridReader>::New();
    if (type == "RectilinearGrid")
        return vtkSmartPointer<vtkXMLRectilinearGridReader>::New();
    if (type == "ImageData")
        return vtkSmartPointer<vtkXMLImageDataReader>::New();
    if (type == "PStructuredGrid")
        return vtkSmartPointer<vtkXMLPStructuredGridReader>::New();
    if (type == "PRectilinearGrid")
        return vtkSmartPointer<vtkXMLPRectilinearGridReader>::New();
    if (type == "PImageData")
        return vtkSmartPointer<vtkXMLPImageDataReader>::New();
    return nullptr;
}

/// The times of the steps that a file holds.
std::vector<double> times_of(vtkXMLReader& reader)
{
    vtkInformation* information = reader.GetOutputInformation(0);
    vtkInformationDoubleVectorKey* key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
    if (!information->Has(key))
        return {};
    const double* times = information->Get(key);
    return {times, times + information->Length(key)};
}

/// Drops the arrays that a piece does not list: VTK takes those of the first piece, and leaves them unset elsewhere.
void drop_arrays_not_listed(vtkDataSet& part, const XmlPieceArrays& listed)
{
    const auto drop = [](vtkDataSetAttributes& attributes, const std::vector<std::string>& names) {
        for (int i = attributes.GetNumberOfArrays(); i-- > 0;) {
            const char* name = attributes.GetAbstractArray(i)->GetName();
            if (name && std::find(names.begin(), names.end(), name) == names.end())
                attributes.RemoveArray(i);
        }
    };
    drop(*part.GetPointData(), listed.of_points);
    drop(*part.GetCellData(), listed.of_cells);
}

} // namespace

std::string declared_xml_type(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::string head(4096, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    const std::size_t tag = head.find("<VTKFile");
    const std::size_t tag_end = tag == std::string::npos ? tag : head.find('>', tag);
    if (tag_end == std::string::npos)
        return {};
    const std::string_view attributes = std::string_view(head).substr(tag, tag_end - tag);
    for (std::size_t at = attributes.find("type"); at != std::string_view::npos; at = attributes.find("type", at + 1)) {
        const std::size_t equals = attributes.find_first_not_of(" \t\r\n", at + 4);
        if (equals == std::string_view::npos || attributes[equals] != '=' || attributes[at - 1] == '_')
            continue; // header_type
        const std::size_t quote = attributes.find_first_of("\"'", equals);
        if (quote != std::string_view::npos)
            return std::string(attributes.substr(quote + 1, attributes.find(attributes[quote], quote + 1) - quote - 1));
    }
    return {};
}

bool is_xml_data_set(const std::string& type)
{
    return reader_of(type) != nullptr;
}

VtkFile read_xml_data_set(const std::filesystem::path& path, const std::string& type, const std::string& time)
{
    check_xml_file(path);
    const vtkSmartPointer<vtkXMLReader> reader = reader_of(type);
    reader->SetFileName(path.c_str());
    VtkFile file{path, {}, false, {}};
    file.notes = run_reader(path, [&] { reader->UpdateInformation(); });
    reader->SetTimeStep(static_cast<int>(choose_time_step(path, times_of(*reader), time, file.notes)));

    auto* in_pieces = vtkXMLUnstructuredDataReader::SafeDownCast(reader);
    const int pieces =
        in_pieces ? static_cast<int>(std::clamp<vtkIdType>(in_pieces->GetNumberOfPieces(), 1, 1 << 20)) : 1;
    const std::vector<XmlPieceArrays> listed = pieces > 1 ? xml_piece_arrays(path) : std::vector<XmlPieceArrays>();
    for (int piece = 0; piece < pieces; ++piece) {
        for (std::string& note : run_reader(path, [&] {
                 if (pieces == 1)
                     reader->Update();
                 else
                     in_pieces->UpdatePiece(piece, pieces, 0);
             }))
            file.notes.push_back(std::move(note));
        auto* output = vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
        if (!output)
            throw InputError(fmt::format("{}: cannot be read: it holds no VTK data set", path.string()));
        const auto part = vtkSmartPointer<vtkDataSet>::Take(output->NewInstance());
        part->ShallowCopy(output);
        if (static_cast<std::size_t>(piece) < listed.size())
            drop_arrays_not_listed(*part, listed[static_cast<std::size_t>(piece)]);
        file.parts.push_back({part, ""});
    }
    if (!has_closing_tag(path))
        throw InputError(fmt::format("{}: cannot be read: it is cut short, there is no </VTKFile>", path.string()));
    return file;
}

VtkFile read_xml_file(const std::filesystem::path& path, const std::string& time)
{
    const std::string type = declared_xml_type(path);
    if (is_xml_data_set(type))
        return read_xml_data_set(path, type, time);
    return read_xml_collection(path, type, time);
}

} // namespace visorder::detail
