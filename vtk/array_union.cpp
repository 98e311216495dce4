#include "vtk/array_union.h"

#include "files/array_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>

namespace visorder::detail {

namespace {

vtkDataSetAttributes& attributes(vtkDataSet& part, bool on_cells)
{
    return on_cells ? static_cast<vtkDataSetAttributes&>(*part.GetCellData()) : *part.GetPointData();
}

/// The number of a tuple, or the magnitude of its numbers.
double magnitude(vtkDataArray& array, vtkIdType tuple)
{
    const int components = array.GetNumberOfComponents();
    if (components == 1)
        return array.GetComponent(tuple, 0);
    double squares = 0;
    for (int i = 0; i < components; ++i) {
        const double value = array.GetComponent(tuple, i);
        squares += value * value;
    }
    return std::sqrt(squares);
}

/// The values of an array over all parts: those of one part after the other, or for points that parts share once.
std::vector<double> values_of(const std::vector<vtkSmartPointer<vtkDataSet>>& parts, bool on_cells, bool shared,
                              const std::string& name, int components)
{
    std::vector<double> values;
    for (const auto& part : parts) {
        vtkDataArray* array = attributes(*part, on_cells).GetArray(name.c_str());
        const bool has_it = array && array->GetNumberOfComponents() == components;
        if (shared && !has_it && part != parts.back())
            continue;
        const vtkIdType wanted = on_cells ? part->GetNumberOfCells() : part->GetNumberOfPoints();
        const std::size_t before = values.size();
        if (has_it)
            for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
                values.push_back(magnitude(*array, i));
        else
            values.resize(before + static_cast<std::size_t>(wanted), std::numeric_limits<double>::quiet_NaN());
        // One that does not fit makes the whole not fit, even if another part had too many where this has too few.
        if (values.size() - before != static_cast<std::size_t>(wanted))
            return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(before), values.end());
        if (shared)
            return values;
    }
    return values;
}

} // namespace

std::vector<FileArray> union_of_arrays(const VtkFile& file, bool on_cells)
{
    std::vector<vtkSmartPointer<vtkDataSet>> parts;
    for (const VtkFile::Part& part : file.parts)
        parts.push_back(part.data);
    const bool shared = file.shared_points && !on_cells;

    std::vector<FileArray> found;
    for (const auto& part : parts) {
        vtkDataSetAttributes& data = attributes(*part, on_cells);
        for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
            vtkDataArray* array = data.GetArray(i); // null for strings
            if (!array || !array->GetName() ||
                std::string_view(array->GetName()) == vtkDataSetAttributes::GhostArrayName())
                continue;
            const std::string name = array->GetName();
            if (std::any_of(found.begin(), found.end(), [&](const FileArray& other) { return other.name == name; }))
                continue;
            const int role = data.IsArrayAnAttribute(i);
            const bool is_whole = array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE;
            const bool holds_ids = role == vtkDataSetAttributes::GLOBALIDS ||
                                   role == vtkDataSetAttributes::PEDIGREEIDS || vtkIdTypeArray::SafeDownCast(array) ||
                                   (is_whole && is_name_of_ids(name));
            const int components = array->GetNumberOfComponents();
            found.push_back({name, on_cells, components, holds_ids,
                             [=] { return values_of(parts, on_cells, shared, name, components); },
                             role == vtkDataSetAttributes::SCALARS, array->GetDataTypeAsString()});
        }
    }
    return found;
}

} // namespace visorder::detail
