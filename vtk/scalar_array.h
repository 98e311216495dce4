#pragma once

#include "vtk/vtk_file.h"

#include <optional>
#include <string>
#include <vtkDataArray.h>

namespace visorder {

/// An array of numbers that every part of a file has.
struct ScalarArray {
    std::string name;
    bool on_cells;
    int components;

    /// The part's own copy.
    vtkDataArray* of(vtkDataSet& part) const;
};

/// The array of that name, of points rather than of cells if both have it; for an empty name the file's default, or the
/// first of one component that does not hold ids, if there is one. Throws InputError, which lists the arrays there are,
/// where the named one is missing.
std::optional<ScalarArray> choose_scalar(const VtkFile& file, const std::string& name);

/// The number of a tuple, or the magnitude of its numbers.
double magnitude(vtkDataArray& array, vtkIdType tuple);

} // namespace visorder
