#include "vtk/scalar_array.h"

#include "scene/error.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>

namespace visorder {

namespace {

vtkDataSetAttributes& attributes(vtkDataSet& part, bool on_cells)
{
    return on_cells ? static_cast<vtkDataSetAttributes&>(*part.GetCellData()) : *part.GetPointData();
}

struct Candidate {
    ScalarArray array;
    bool holds_ids;
};

/// The arrays of the first part that the others have too, with as many components.
std::vector<Candidate> candidates(const VtkFile& file, bool on_cells)
{
    std::vector<Candidate> found;
    vtkDataSetAttributes& first = attributes(*file.parts.front(), on_cells);
    for (int i = 0; i < first.GetNumberOfArrays(); ++i) {
        vtkDataArray* array = first.GetArray(i); // null for strings
        if (!array || !array->GetName() || std::string_view(array->GetName()) == vtkDataSetAttributes::GhostArrayName())
            continue;
        const ScalarArray candidate{array->GetName(), on_cells, array->GetNumberOfComponents()};
        const bool in_all_parts = std::all_of(file.parts.begin(), file.parts.end(), [&](vtkDataSet* part) {
            const vtkDataArray* own = candidate.of(*part);
            return own && own->GetNumberOfComponents() == candidate.components;
        });
        const int role = first.IsArrayAnAttribute(i);
        if (in_all_parts)
            found.push_back({candidate, role == vtkDataSetAttributes::GLOBALIDS ||
                                            role == vtkDataSetAttributes::PEDIGREEIDS ||
                                            vtkIdTypeArray::SafeDownCast(array)});
    }
    return found;
}

std::string listed(const std::vector<Candidate>& all)
{
    std::vector<std::string> names;
    for (const Candidate& candidate : all)
        names.push_back(candidate.array.name + (candidate.array.on_cells ? " (of cells)" : ""));
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

} // namespace

vtkDataArray* ScalarArray::of(vtkDataSet& part) const
{
    return attributes(part, on_cells).GetArray(name.c_str());
}

std::optional<ScalarArray> choose_scalar(const VtkFile& file, const std::string& name)
{
    std::vector<Candidate> all = candidates(file, false);
    const std::vector<Candidate> of_cells = candidates(file, true);
    all.insert(all.end(), of_cells.begin(), of_cells.end());

    const std::string& wanted = name.empty() ? file.default_scalar : name;
    const auto chosen = std::find_if(all.begin(), all.end(), [&](const Candidate& candidate) {
        return wanted.empty() ? candidate.array.components == 1 && !candidate.holds_ids
                              : candidate.array.name == wanted;
    });
    if (chosen != all.end())
        return chosen->array;
    if (!wanted.empty())
        throw InputError(fmt::format("{}: no scalar \"{}\"{}; it has: {}", file.path.string(), wanted,
                                     file.parts.size() > 1 ? " in all of its blocks" : "", listed(all)));
    return {};
}

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

} // namespace visorder
