#pragma once

#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>
#include <vector>

namespace visorder::tests {

/// A .vtu file in text, made of what is set.
struct VtuText {
    struct Cell {
        int type;
        std::vector<int> points;
    };
    struct Array {
        std::string name;
        int components;
        std::vector<double> values;
        std::string type = "Float64";
    };

    std::vector<std::array<double, 3>> points;
    std::vector<Cell> cells;
    std::vector<Array> point_arrays;
    std::vector<Array> cell_arrays;
    std::string cell_attributes;
    std::string point_attributes;

    std::string str() const
    {
        std::vector<double> coordinates;
        for (const auto& p : points)
            coordinates.insert(coordinates.end(), p.begin(), p.end());
        std::vector<int> connectivity, offsets, types;
        for (const Cell& cell : cells) {
            connectivity.insert(connectivity.end(), cell.points.begin(), cell.points.end());
            offsets.push_back(static_cast<int>(connectivity.size()));
            types.push_back(cell.type);
        }
        return fmt::format(R"(<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="{}" NumberOfCells="{}">
<PointData {}>{}</PointData><CellData {}>{}</CellData><Points>{}</Points><Cells>{}{}{}</Cells>
</Piece></UnstructuredGrid></VTKFile>
)",
                           points.size(), cells.size(), point_attributes, text(point_arrays), cell_attributes,
                           text(cell_arrays), text(Array{"Points", 3, coordinates}),
                           text("Int64", "connectivity", 1, connectivity), text("Int64", "offsets", 1, offsets),
                           text("UInt8", "types", 1, types));
    }

private:
    template <class T>
    static std::string text(const std::string& type, const std::string& name, int components, const std::vector<T>& all)
    {
        return fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">{}</DataArray>\n", type,
            name, components, fmt::join(all, " "));
    }

    static std::string text(const Array& array) { return text(array.type, array.name, array.components, array.values); }

    static std::string text(const std::vector<Array>& arrays)
    {
        std::string all;
        for (const Array& array : arrays)
            all += text(array);
        return all;
    }
};

/// Two unit tetrahedra that share the face in the plane x = 0, of points 0, 1, 2.
inline VtuText vtu_of_two_tetrahedra()
{
    VtuText vtu;
    vtu.points = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}};
    vtu.cells = {{10, {0, 1, 2, 3}}, {10, {0, 2, 1, 4}}};
    return vtu;
}

} // namespace visorder::tests
